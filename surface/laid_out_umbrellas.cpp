#include "surface/laid_out_umbrellas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "delaunay/base/parallel.h"

namespace deliso {

namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;

constexpr std::size_t kMostTriangles = 16;  // of a vertex that is looked at
constexpr std::size_t kVerticesPerTask = 8192;

// The edge across from a corner of a triangle.
struct LinkEdge {
  std::uint32_t from = 0, to = 0;
};

// The corners at each vertex, in the order of the triangles. Precondition: four times the triangles fit into 32 bits.
class CornersOfVertices {
 public:
  CornersOfVertices(std::size_t vertices, Triangles triangles)
      : triangles_(triangles), begin_(vertices + 2), corners_(3 * triangles.size()) {
    for (const auto& corners : triangles) {
      for (const std::uint32_t v : corners) ++begin_[v + 2];
    }
    for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::uint32_t i = 0; i < 3; ++i) corners_[begin_[triangles[t][i] + 1]++] = t << 2 | i;
    }
  }
  [[nodiscard]] std::size_t count(std::size_t v) const { return begin_[v + 1] - begin_[v]; }
  // Across from corner i at v.
  [[nodiscard]] LinkEdge edge(std::size_t v, std::size_t i) const {
    constexpr std::array<std::size_t, 3> kNext = {1, 2, 0}, kPrevious = {2, 0, 1};
    const std::uint32_t corner = corners_[begin_[v] + i];
    const auto& triangle = triangles_[corner >> 2];
    return {triangle[kNext[corner & 3]], triangle[kPrevious[corner & 3]]};
  }

 private:
  Triangles triangles_;
  std::vector<std::uint32_t> begin_, corners_;
};

// The vertices of a link in a row, when its edges form one cycle. Precondition: at least one, at most kMostTriangles.
class LinkCycle {
 public:
  LinkCycle(const CornersOfVertices& corners, std::size_t v) {
    corners.count(v) <= kMostTriangles / 2 ? follow<kMostTriangles / 2>(corners, v)
                                           : follow<kMostTriangles>(corners, v);
  }
  [[nodiscard]] bool is_closed() const { return is_closed_; }
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return std::span(vertices_).first(size_); }

 private:
  // Of a link with at most so many edges.
  template <std::size_t kMost>
  void follow(const CornersOfVertices& corners, std::size_t v) {
    const std::size_t count = corners.count(v);
    std::array<std::uint32_t, kMost> from, to;
    from.fill(0xFFFFFFFFU);
    for (std::size_t i = 0; i < count; ++i) {
      const LinkEdge edge = corners.edge(v, i);
      from[i] = edge.from;
      to[i] = edge.to;
    }
    std::uint32_t seen = 0;
    for (std::size_t next = 0; size_ < count; ++size_) {
      vertices_[size_] = from[next];
      // Without branches, for the next edge cannot be foretold.
      std::uint32_t places = 0;
      for (std::size_t i = 0; i < kMost; ++i) places |= from[i] == to[next] ? 1U << i : 0U;
      if (places == 0 || (places & (places - 1)) != 0) return;
      next = static_cast<std::size_t>(std::countr_zero(places));
      seen |= places;
    }
    is_closed_ = seen == (1U << count) - 1;
  }

  std::array<std::uint32_t, kMostTriangles> vertices_{};
  std::size_t size_ = 0;
  bool is_closed_ = false;
};

// Whether the rays from the origin along the `spokes`, seen along the axis, go around it once, each less than half a
// turn from the one before it, all in the same sense. Differences of coordinates may be rounded: that is in the bound.
bool go_around_once(std::span<const Vec3> spokes, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  // Of the determinant of rounded differences (Shewchuk 1997); the summand covers products that underflow.
  constexpr double kRelative = 3.3306690738754716e-16, kUnderflow = 1e-300;
  bool all_left = true, all_right = true;
  int changes = 0;  // of the side of the u axis; a rounded difference has the sign of the exact one
  const Vec3* last = &spokes.back();
  for (const Vec3& spoke : spokes) {
    const double left = (*last)[u] * spoke[v], right = (*last)[v] * spoke[u];
    const double determinant = left - right, error = kRelative * (std::abs(left) + std::abs(right)) + kUnderflow;
    all_left &= determinant > error;
    all_right &= determinant < -error;
    changes += ((*last)[v] < 0) != (spoke[v] < 0) ? 1 : 0;
    last = &spoke;
  }
  return (all_left || all_right) && changes == 2;
}

bool is_laid_out(std::span<const Vec3> points, const CornersOfVertices& corners, std::size_t v) {
  const std::size_t count = corners.count(v);
  if (count < 3 || count > kMostTriangles) return false;
  const LinkCycle cycle(corners, v);
  if (!cycle.is_closed()) return false;

  std::array<Vec3, kMostTriangles> differences;
  const auto spokes = std::span(differences).first(count);
  for (std::size_t i = 0; i < count; ++i) spokes[i] = points[cycle.vertices()[i]] - points[v];
  Vec3 normal = cross(spokes.back(), spokes.front());
  for (std::size_t i = 1; i < spokes.size(); ++i) normal += cross(spokes[i - 1], spokes[i]);
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  return go_around_once(spokes, x >= y && x >= z ? 0 : y >= z ? 1 : 2);
}

}  // namespace

std::vector<std::uint8_t> laid_out_umbrellas(std::span<const Vec3> points, Triangles triangles, int threads) {
  std::vector<std::uint8_t> laid_out(points.size());
  if (triangles.size() > 0xFFFFFFFFU / 4) return laid_out;
  const CornersOfVertices corners(points.size(), triangles);
  const std::size_t tasks = (points.size() + kVerticesPerTask - 1) / kVerticesPerTask;
  run_tasks(tasks, threads, [&](std::size_t task) {
    const std::size_t end = std::min((task + 1) * kVerticesPerTask, points.size());
    for (std::size_t v = task * kVerticesPerTask; v < end; ++v) {
      laid_out[v] = is_laid_out(points, corners, v) ? 1 : 0;
    }
  });
  return laid_out;
}

}  // namespace deliso
