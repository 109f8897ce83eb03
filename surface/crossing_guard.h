// Keeps stage 2 from making triangles that cross others, where the surface comes near to itself.
//
// Replacing a disk by a star moves the mesh by no more than the disk was off the surface, so it can meet another sheet
// only where the distance between the sheets is no larger than its triangles. The guard knows a bound of that distance
// at every vertex, its clearance: the pole height, but no more than the distance to a vertex that has another one on
// top of it. Triangles larger than their clearance are tight. Only these are kept by place, and only stars that would
// have such triangles are tested against them, exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/surface_mesh.h"

namespace deliso {

class CrossingGuard {
 public:
  using Edge = std::array<std::uint32_t, 2>;

  // Keeps a reference to the mesh and a few bytes for each of its triangles and vertices. Near `suspects` no clearance
  // is trusted.
  CrossingGuard(SurfaceMesh& mesh, std::span<const Vec3> suspects);

  // Whether the triangles (p, from, to) for the edges of a rim meet each other or tight triangles of the mesh beyond
  // what they share; triangles t with disk[t] == attempt are about to go and do not count. `moved`: how far the mesh
  // moves at most. Also finds p's clearance.
  bool crosses(const Vec3& p, double moved, std::span<const Edge> rim, std::span<const std::uint32_t> disk,
               std::uint32_t attempt);

  // Before a triangle goes; after p has become the newest vertex; after a triangle has come.
  void forget(std::uint32_t triangle);
  void add_vertex() { clearance_.push_back(new_clearance_); }
  void learn(std::uint32_t triangle);

 private:
  using Corners = std::array<std::uint32_t, 3>;
  // Cells of 2^level mesh-space units; a triangle is kept at the level of its size, at which it meets few cells.
  struct Cell {
    int level = 0;
    std::array<std::int32_t, 3> at{};
  };
  static constexpr int kLevels = 64;

  [[nodiscard]] bool is_tight(const Corners& v) const;
  [[nodiscard]] Box3 box_of(const Corners& v) const;
  [[nodiscard]] bool meets(const Corners& v, const Box3& box, const Corners& w) const;
  template <class Visit>
  void for_each_cell(const Box3& box, int level, Visit&& visit) const;
  static int level_of(const Box3& box);
  static std::uint64_t key(const Cell& cell);

  SurfaceMesh& mesh_;
  std::vector<float> clearance_;  // of each vertex
  float new_clearance_ = 0;
  std::vector<bool> is_kept_;  // of each triangle
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::array<std::size_t, kLevels> kept_at_{};  // entries at each level
};

}  // namespace deliso
