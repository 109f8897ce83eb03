#include "surface/mesh/flat_triangles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "surface/mesh/side_adjacency.h"
#include "surface/mesh/triangle_area.h"

namespace deliso {

namespace {

using Corners = std::array<std::uint32_t, 3>;

class FlatTriangles {
 public:
  explicit FlatTriangles(SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (is_flat(t)) flat_.push_back(t);
    }
    if (!flat_.empty()) set_side_adjacency(mesh_);
  }

  std::int64_t run() {
    constexpr int kMostRounds = 64;  // two of them on one edge may take turns
    std::int64_t count = 0;
    for (int round = 0; round < kMostRounds && !flat_.empty(); ++round) {
      const std::int64_t before = count;
      const std::vector<std::uint32_t> now = flat_;
      for (const std::uint32_t t : now) count += is_flat(t) && flip(t) ? 1 : 0;
      std::sort(flat_.begin(), flat_.end());
      flat_.erase(std::unique(flat_.begin(), flat_.end()), flat_.end());
      std::erase_if(flat_, [&](std::uint32_t t) { return !is_flat(t); });
      if (count == before) break;
    }
    return count;
  }

 private:
  [[nodiscard]] const Vec3& point(std::uint32_t triangle, unsigned corner) const {
    return mesh_.points[mesh_.triangles[triangle].at(corner % 3)];
  }

  [[nodiscard]] bool is_flat(std::uint32_t t) const { return is_without_area(point(t, 0), point(t, 1), point(t, 2)); }

  // The corner that lies between the two others.
  [[nodiscard]] std::optional<unsigned> middle(std::uint32_t t) const {
    for (unsigned i = 0; i < 3; ++i) {
      if (dot(point(t, i + 1) - point(t, i), point(t, i + 2) - point(t, i)) < 0) return i;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_edge(std::uint32_t triangle, unsigned corner, std::uint32_t end) const {
    const std::uint32_t first = 3 * triangle + corner;
    bool found = false;
    const auto across = [&](TriangleSide side) { return mesh_.neighbours[side >> 2].at(side & 3u); };
    std::vector<std::uint32_t> visited;
    for_each_corner_of_fan(first, across, [&](std::uint32_t c) {
      const Corners& corners = mesh_.triangles[c / 3];
      found = found || std::find(corners.begin(), corners.end(), end) != corners.end();
      if (std::find(visited.begin(), visited.end(), c) != visited.end()) return false;
      visited.push_back(c);
      return true;
    });
    return found;
  }

  void join(std::uint32_t t, unsigned corner, TriangleSide beyond) {
    mesh_.neighbours[t].at(corner) = beyond;
    if (beyond != kNoSide) mesh_.neighbours[beyond >> 2].at(beyond & 3u) = 4 * t + corner;
  }

  // Triangle (m, a, b), with m between a and b, and its neighbour (x, b, a) become (m, a, x) and (m, x, b).
  bool flip(std::uint32_t t) {
    const std::optional<unsigned> m = middle(t);
    if (!m) return false;
    const TriangleSide side = mesh_.neighbours[t].at(*m);
    if (side == kNoSide) return false;
    const std::uint32_t u = side >> 2;
    const unsigned x = side & 3u;
    // A neighbour in the same line comes first, unless its middle is on this edge, too.
    if (u == t || (is_flat(u) && middle(u) != x)) return false;
    const Corners old_t = mesh_.triangles[t], old_u = mesh_.triangles[u];
    const std::uint32_t vm = old_t.at(*m), va = old_t.at((*m + 1) % 3), vb = old_t.at((*m + 2) % 3), vx = old_u.at(x);
    if (vm == vx || old_u.at((x + 1) % 3) != vb || old_u.at((x + 2) % 3) != va || is_edge(t, *m, vx)) return false;
    const TriangleSide beyond_bm = mesh_.neighbours[t].at((*m + 1) % 3),
                       beyond_ma = mesh_.neighbours[t].at((*m + 2) % 3);
    const TriangleSide beyond_ax = mesh_.neighbours[u].at((x + 1) % 3), beyond_xb = mesh_.neighbours[u].at((x + 2) % 3);
    mesh_.triangles[t] = {vm, va, vx};
    mesh_.triangles[u] = {vm, vx, vb};
    join(t, 0, beyond_ax);
    join(t, 1, 4 * u + 2);
    join(t, 2, beyond_ma);
    join(u, 0, beyond_xb);
    join(u, 1, beyond_bm);
    flat_.push_back(u);
    return true;
  }

  SurfaceMesh& mesh_;
  std::vector<std::uint32_t> flat_;
};

}  // namespace

std::int64_t flip_flat_triangles(SurfaceMesh& mesh) { return FlatTriangles(mesh).run(); }

}  // namespace deliso
