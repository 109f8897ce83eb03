// Samples for a second time of stage 1, where the mesh of the first stays too far from the isosurface.
#pragma once

#include <set>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/certificate/geometry_check.h"
#include "surface/mesh/surface_mesh.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

class CellsNearFaults {
 public:
  // Keeps a reference.
  explicit CellsNearFaults(const Isosurface& isosurface) : isosurface_(isosurface) {}

  // Adds the cells at which a mesh (in mesh space) is too far from the isosurface, and those next to them.
  void add(const SurfaceMesh& mesh, const GeometryCheck& check);

  [[nodiscard]] std::size_t count() const { return cells_.size(); }
  // Where the isosurface meets the edges of a lattice that divides each of the cells, in their order. `spacing`: of the
  // lattice, at most (mesh-space units).
  [[nodiscard]] std::vector<Vec3> samples(double spacing) const;

 private:
  void add(const Box3& box);
  void append_hits(const CellIndex& cell, std::size_t axis, double spacing, std::vector<Vec3>& samples) const;

  const Isosurface& isosurface_;
  std::set<CellIndex> cells_;
};

}  // namespace deliso
