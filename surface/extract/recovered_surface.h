// What Recover leaves to Refine (Dey and Levine, Figure 9): Del S1, from which ComputePoles and BuildTriMesh make the
// mesh that RefineGeom begins with.
#pragma once

#include <memory>
#include <vector>

#include "surface/base/parameters.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

// Call compute_poles, build_triangle_mesh and mend once each, in this order.
class RecoveredSurface {
 public:
  RecoveredSurface() = default;
  RecoveredSurface(const RecoveredSurface&) = delete;
  RecoveredSurface& operator=(const RecoveredSurface&) = delete;
  virtual ~RecoveredSurface() = default;

  // ComputePoles: the pole heights of all vertices that the mesh will have.
  virtual void compute_poles() = 0;
  // BuildTriMesh: the mesh, with pole heights.
  virtual SurfaceMesh build_triangle_mesh() = 0;
  // Changes to the mesh before RefineGeom; none in the paper.
  virtual void mend(SurfaceMesh& /*mesh*/) {}
  // Seconds that mend() has spent on ComputePoles and BuildTriMesh of further meshes.
  [[nodiscard]] virtual double inner_poles_seconds() const { return 0; }
  [[nodiscard]] virtual double inner_build_seconds() const { return 0; }
  // False only without one sign per tetrahedron: then the restricted facets bound no set of tetrahedra, so they are
  // output unchanged as the mesh, and RefineGeom is left out.
  [[nodiscard]] virtual bool bounds_a_solid() const { return true; }
};

// The paper's own way: Del S1 as it is.
class UnrepairedSurface : public RecoveredSurface {
 public:
  UnrepairedSurface(std::unique_ptr<RestrictedDelaunay> restricted, const Parameters& parameters);

  void compute_poles() override;
  SurfaceMesh build_triangle_mesh() override;
  [[nodiscard]] bool bounds_a_solid() const override { return bounds_a_solid_; }

 private:
  std::unique_ptr<RestrictedDelaunay> restricted_;
  PoleHeight rule_;
  bool bounds_a_solid_ = true;
  std::vector<double> pole_heights_;  // of each vertex of the triangulation
};

}  // namespace deliso
