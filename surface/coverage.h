// Whether a mesh covers the isosurface: a finger of the surface may hide within one Voronoi cell, where neither
// topology nor any dual edge tells of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "surface/box_tree.h"
#include "surface/restricted_delaunay.h"
#include "surface/surface_mesh.h"
#include "volume/exact_topology.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The triangles of a mesh by place, for asking whether many points of the surface lie near them.
class MeshCover {
 public:
  // Keeps a reference to the mesh. Many questions are answered faster when its triangles have neighbours.
  explicit MeshCover(const SurfaceMesh& mesh, int threads = 1);

  // Whether p lies within 0.8 mesh-space units of some triangle, or within 0.3 circumradii of the nearest one (of a
  // sliver, 0.3 longest edges): a coarse triangle may well be that far off the surface that it approximates. The search
  // begins at the triangle `guess`, which becomes the one that covers p, if any: a good guess for a point nearby. The
  // answer does not depend on it.
  [[nodiscard]] bool covers(const Vec3& p, std::uint32_t& guess) const { return look(p, guess) != Cover::kNone; }
  // The same, and whether it is within 0.5 units.
  enum class Cover : std::uint8_t { kNone, kFar, kClose };
  [[nodiscard]] Cover look(const Vec3& p, std::uint32_t& guess) const;

 private:
  [[nodiscard]] double squared_distance_to(const Vec3& p, std::uint32_t triangle) const;
  // Where a walk over the mesh that comes ever nearer to p ends, or was given up; and its squared distance.
  [[nodiscard]] std::pair<std::uint32_t, double> walk_towards(const Vec3& p, std::uint32_t start) const;

  const SurfaceMesh& mesh_;
  BoxTree tree_;
};

// Whether a sample lies within 0.65 mesh-space units of a triangle.
bool is_covered_by(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle);
// For each of a few points, on several threads: the first triangle t that covers it so and for which takes(t) holds;
// kNoTriangle when there is none.
inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;
std::vector<std::uint32_t> covering_triangles(const std::vector<Vec3>& points, const SurfaceMesh& mesh,
                                              const std::function<bool(std::uint32_t)>& takes, int threads = 1);

// Inserts grid-edge crossings that the mesh of the triangulation does not cover (see MeshCover), unless a vertex is
// nearer than `min_distance`. `suspects` are the crossings to ask about (places in topology.crossings); those that are
// not covered stay in it. Returns how many went in; stage 1 has to go on then. `landmarks`, when asked for, gets those
// that the mesh is not close to (MeshCover::look), covered or not. The same for any number of threads.
std::int64_t insert_uncovered(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology& topology, double min_distance,
                              std::vector<std::uint32_t>& suspects, int threads = 1,
                              std::vector<Vec3>* landmarks = nullptr);

// All crossings, in an order that keeps neighbours together.
std::vector<std::uint32_t> all_crossings(const ScalarGrid& grid, const IsosurfaceTopology& topology, int threads = 1);

}  // namespace deliso
