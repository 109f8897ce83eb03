#include "surface/extract/recovered_surface.h"

#include <optional>
#include <utility>

#include "surface/extract/build_triangle_mesh.h"
#include "surface/extract/edge_positions.h"
#include "surface/extract/pinch_separation.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/signs_from_facets.h"

namespace deliso {

// Without one sign per tetrahedron the tetrahedra get the signs that follow from the restricted facets, if these are
// consistent.
UnrepairedSurface::UnrepairedSurface(std::unique_ptr<RestrictedDelaunay> restricted, const Parameters& parameters)
    : restricted_(std::move(restricted)), rule_(parameters.stage2.pole_height) {
  if (parameters.stage1.one_sign_per_tetrahedron) return;
  const std::optional<TetSigns> signs = signs_from_facets(*restricted_);
  bounds_a_solid_ = signs.has_value();
  if (signs) restricted_->set_signs(*signs);
}

void UnrepairedSurface::compute_poles() {
  if (bounds_a_solid_) pole_heights_ = deliso::compute_poles(*restricted_, rule_);
}

SurfaceMesh UnrepairedSurface::build_triangle_mesh() {
  if (!bounds_a_solid_) return facets_alone(*restricted_);
  BuiltMesh built = deliso::build_triangle_mesh(*restricted_);
  find_other_positions(built.groups, restricted_->isosurface());
  separate_pinches(built.mesh, built.groups, built.vertex_of, restricted_->isosurface().box(),
                   restricted_->isosurface().surface_box());
  for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(pole_heights_[v.index()]);
  return std::move(built.mesh);
}

}  // namespace deliso
