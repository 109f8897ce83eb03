#include "surface/repair/finish/inverted_umbrellas.h"

#include <algorithm>
#include <array>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/triangle_contact.h"
#include "raycast/gradients_at.h"
#include "surface/base/parallel_blocks.h"
#include "surface/mesh/minimum_area_triangulation.h"
#include "surface/mesh/vertex_decimation.h"
#include "surface/search/box_tree.h"
#include "surface/search/nearness.h"

namespace deliso {

namespace {

// Only inverted umbrellas with an edge longer than this (mesh-space units) are considered.
constexpr double kLeastEdge = 1;

// The number of vertices that a thread takes at a time.
constexpr std::size_t kNormalsAtOnce = 2048;
// The number of consecutive triangles that share a box in searches of the whole mesh: most lie near their predecessors.
constexpr std::size_t kTrianglesAtOnce = 32;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class InvertedUmbrellas {
 public:
  InvertedUmbrellas(SurfaceMesh& mesh, const Isosurface& isosurface)
      : mesh_(mesh), isosurface_(isosurface), fans_(mesh) {}

  std::int64_t remove_all(int threads);

 private:
  // A vertex whose triangles face against the surface, and all triangles that meet a box around it, except those
  // replaced since.
  struct Apex {
    std::uint32_t vertex = 0;
    Box3 box;
    std::vector<std::uint32_t> surroundings;
  };
  void find_apexes(int threads);
  void find_surroundings();
  void update_surroundings(Apex& apex, const Box3& box);
  bool remove(Apex& apex);
  void append_apexes(const std::vector<std::uint32_t>& link);
  [[nodiscard]] Triangles triangles_of(const VertexFan& fan) const;
  [[nodiscard]] Box3 box_around(std::uint32_t v, const VertexFan& fan) const;
  [[nodiscard]] bool can_be_filled(std::uint32_t v, const VertexFan& fan) const;
  [[nodiscard]] double far_area(const Triangles& triangles);
  [[nodiscard]] bool is_covered(const Apex& apex, const Triangles& filling) const;
  [[nodiscard]] bool is_free(const Apex& apex, const Triangles& filling) const;
  // Whether holds(t) is true for some triangle t around the apex that is not at the apex itself.
  template <class Holds>
  [[nodiscard]] bool any_around(const Apex& apex, const Holds& holds) const {
    const auto stays_and_holds = [&](std::uint32_t i) {
      const auto& t = mesh_.triangles[i];
      return fans_.has_triangle(i) && std::find(t.begin(), t.end(), apex.vertex) == t.end() && holds(t);
    };
    return std::any_of(apex.surroundings.begin(), apex.surroundings.end(), stays_and_holds) ||
           std::any_of(fans_.renewed().begin(), fans_.renewed().end(), stays_and_holds);
  }
  [[nodiscard]] bool is_against(std::uint32_t v, const Vec3& normals) const;

  [[nodiscard]] Vec3 normal(const std::array<std::uint32_t, 3>& t) const {
    return cross(mesh_.points[t[1]] - mesh_.points[t[0]], mesh_.points[t[2]] - mesh_.points[t[0]]);
  }
  [[nodiscard]] bool has_area_at(const std::array<std::uint32_t, 3>& t) const {
    return has_area(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
  }

  SurfaceMesh& mesh_;
  const Isosurface& isosurface_;
  VertexDecimation fans_;
  std::vector<Apex> apexes_;
  std::vector<Box3> boxes_;  // of kTrianglesAtOnce triangles each, of the mesh before any removal
  SearchCounters search_;
};

std::int64_t InvertedUmbrellas::remove_all(int threads) {
  find_apexes(threads);
  if (apexes_.empty()) return 0;
  find_surroundings();
  // Neighbouring inverted umbrellas are removed one by one; repeat, because what prevented one removal may be gone
  // after another.
  std::int64_t removed = 0;
  for (std::int64_t before = -1; before != removed;) {
    before = removed;
    for (std::size_t a = 0; a < apexes_.size(); ++a) {
      if (fans_.has(apexes_[a].vertex) && remove(apexes_[a])) ++removed;
    }
  }
  if (removed > 0) fans_.drop_free_slots();
  return removed;
}

Triangles InvertedUmbrellas::triangles_of(const VertexFan& fan) const {
  Triangles triangles;
  for (const std::uint32_t t : fan.triangles) triangles.push_back(mesh_.triangles[t]);
  return triangles;
}

// Finds the inner vertices with a long edge whose triangles face against the surface on the whole.
void InvertedUmbrellas::find_apexes(int threads) {
  std::vector<bool> is_long(mesh_.points.size(), false), is_open(mesh_.points.size(), false);
  std::vector<Vec3> normals(mesh_.points.size());  // sums over the triangles at a vertex
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Vec3 n = normal(mesh_.triangles[t]);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh_.triangles[t][(i + 1) % 3], w = mesh_.triangles[t][(i + 2) % 3];
      if (mesh_.neighbours[t][i] == kNoSide) is_open[v] = is_open[w] = true;
      if (squared_distance(mesh_.points[v], mesh_.points[w]) > kLeastEdge * kLeastEdge) is_long[v] = is_long[w] = true;
      normals[v] += n;
    }
  }
  const auto append_if_against = [&](std::size_t i, std::vector<std::uint32_t>& found) {
    const auto v = static_cast<std::uint32_t>(i);
    if (is_long[v] && !is_open[v] && is_against(v, normals[v])) found.push_back(v);
  };
  for (const std::uint32_t v :
       collect_in_blocks<std::uint32_t>(normals.size(), threads, append_if_against, kNormalsAtOnce)) {
    apexes_.push_back({v, {}, {}});
  }
}

// The gradients of all cells at the vertex are tried; one is enough.
bool InvertedUmbrellas::is_against(std::uint32_t v, const Vec3& normals) const {
  bool is_against = false;
  for_each_gradient_at(isosurface_, mesh_.points[v],
                       [&](const Vec3& gradient) { is_against |= dot(normals, gradient) > 0; });
  return is_against;
}

// Finds, for all apexes in one pass, the triangles that meet the box of each.
void InvertedUmbrellas::find_surroundings() {
  std::vector<Box3> boxes;
  for (Apex& apex : apexes_) {
    VertexFan fan;
    fans_.find(apex.vertex, fan);
    apex.box = box_around(apex.vertex, fan);
    boxes.push_back(apex.box);
  }
  const BoxTree tree(boxes);
  boxes_.resize((mesh_.triangles.size() + kTrianglesAtOnce - 1) / kTrianglesAtOnce);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Box3 box = box_of(mesh_, t);
    boxes_[t / kTrianglesAtOnce].extend(box.low);
    boxes_[t / kTrianglesAtOnce].extend(box.high);
    tree.for_each_meeting(box, [&](std::uint32_t a) { apexes_[a].surroundings.push_back(t); });
  }
}

// A box that holds everything that may replace the triangles at a vertex or cover it.
Box3 InvertedUmbrellas::box_around(std::uint32_t v, const VertexFan& fan) const {
  Box3 box;
  for (const std::uint32_t w : fan.link) box.extend(mesh_.points[w]);
  const Vec3 around{nearness::kRemoved, nearness::kRemoved, nearness::kRemoved};
  box.extend(mesh_.points[v] - around);
  box.extend(mesh_.points[v] + around);
  return box;
}

// Finds the triangles around an apex again if its link has grown beyond its box. Triangles that have been replaced are
// among the renewed ones, so the boxes of the old mesh suffice.
void InvertedUmbrellas::update_surroundings(Apex& apex, const Box3& box) {
  if (apex.box.contains(box.low) && apex.box.contains(box.high)) return;
  apex.box = box;
  apex.surroundings.clear();
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].meets(box)) continue;
    const std::size_t last = std::min((i + 1) * kTrianglesAtOnce, mesh_.triangles.size());
    for (std::size_t t = i * kTrianglesAtOnce; t < last; ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      if (fans_.has_triangle(triangle) && box.meets(box_of(mesh_, triangle))) apex.surroundings.push_back(triangle);
    }
  }
}

bool InvertedUmbrellas::remove(Apex& apex) {
  VertexFan fan;
  if (!fans_.find(apex.vertex, fan) || !can_be_filled(apex.vertex, fan)) return false;
  const MinimumAreaTriangulation least = fans_.least_filling(fan);
  if (!least.exists()) return false;
  Triangles filling;
  for (const auto& [i, k, j] : least.triangles()) filling.push_back({fan.link[i], fan.link[k], fan.link[j]});
  if (!(far_area(filling) < far_area(triangles_of(fan)))) return false;
  update_surroundings(apex, box_around(apex.vertex, fan));
  if (!is_covered(apex, filling) || !is_free(apex, filling)) return false;
  fans_.replace(apex.vertex, fan, least);
  append_apexes(fan.link);
  return true;
}

// A removal may make neighbouring vertices into inverted umbrellas.
void InvertedUmbrellas::append_apexes(const std::vector<std::uint32_t>& link) {
  for (const std::uint32_t v : link) {
    const bool is_known = std::any_of(apexes_.begin(), apexes_.end(), [v](const Apex& a) { return a.vertex == v; });
    VertexFan fan;
    if (!is_known && fans_.find(v, fan) && can_be_filled(v, fan)) apexes_.push_back({v, {}, {}});
  }
}

// Whether the link can be filled, and the vertex is still an inverted umbrella after the removals around it.
bool InvertedUmbrellas::can_be_filled(std::uint32_t v, const VertexFan& fan) const {
  if (!fans_.can_be_filled(fan)) return false;
  Vec3 sum;
  for (const std::uint32_t t : fan.triangles) sum += normal(mesh_.triangles[t]);
  return is_against(v, sum);
}

// The area of those triangles that have no part of the surface which faces the same way near their centroid.
double InvertedUmbrellas::far_area(const Triangles& triangles) {
  double area = 0;
  for (const auto& t : triangles) {
    const Vec3 n = normal(t), middle = (mesh_.points[t[0]] + mesh_.points[t[1]] + mesh_.points[t[2]]) / 3;
    if (!(norm(n) > 0)) continue;
    if (!isosurface_.nearest_falling_hit({middle, n / norm(n)}, nearness::kFacing, search_)) area += 0.5 * norm(n);
  }
  return area;
}

// Whether the mesh without the vertex is still near the vertex, which lies on the surface.
bool InvertedUmbrellas::is_covered(const Apex& apex, const Triangles& filling) const {
  const auto is_near = [&](const std::array<std::uint32_t, 3>& t) {
    return nearness::is_near(mesh_.points[apex.vertex], mesh_, t, nearness::kRemoved);
  };
  return std::any_of(filling.begin(), filling.end(), is_near) || any_around(apex, is_near);
}

// Whether the filling meets no triangle around the apex, nor itself, beyond what the triangles share.
bool InvertedUmbrellas::is_free(const Apex& apex, const Triangles& filling) const {
  const auto meets = [&](const std::array<std::uint32_t, 3>& s, const std::array<std::uint32_t, 3>& t) {
    return has_area_at(t) && triangle_contact(mesh_.points, s, t) != TriangleContact::kNone;
  };
  for (std::size_t i = 0; i < filling.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (meets(filling[i], filling[j])) return false;
    }
  }
  return !any_around(apex, [&](const auto& t) {
    return std::any_of(filling.begin(), filling.end(), [&](const auto& s) { return meets(s, t); });
  });
}

}  // namespace

std::int64_t remove_inverted_umbrellas(SurfaceMesh& mesh, const Isosurface& isosurface, int threads) {
  return InvertedUmbrellas(mesh, isosurface).remove_all(threads);
}

}  // namespace deliso
