// What a refinement has changed: kept, taken back, and applied again.
#include <cstddef>
#include <utility>

#include "surface/refine/refine_loop.h"

namespace deliso {

RefinementChange RefineLoop::take_back() {
  RefinementChange change = start_->restore(mesh_);
  start_.reset();
  return change;
}

void RefineLoop::Start::keep(std::uint32_t t, const RefinementMesh& mesh) {
  if (t >= is_kept_.size() || is_kept_[t]) return;
  is_kept_[t] = true;
  places_.push_back(t);
  triangles_.push_back(mesh.triangles[t]);
}

RefinementChange RefineLoop::Start::restore(RefinementMesh& mesh) {
  RefinementChange change;
  change.new_triangles.assign(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(is_kept_.size()),
                              mesh.triangles.end());
  change.new_vertices.assign(mesh.vertices.begin() + static_cast<std::ptrdiff_t>(vertex_count_), mesh.vertices.end());
  for (std::size_t i = 0; i < places_.size(); ++i) std::swap(mesh.triangles[places_[i]], triangles_[i]);
  change.places = std::move(places_);
  change.triangles = std::move(triangles_);
  mesh.triangles.resize(is_kept_.size());
  mesh.vertices.resize(vertex_count_);
  mesh.forget_attempts();
  return change;
}

void RefinementChange::redo(RefinementMesh& mesh) const {
  for (std::size_t i = 0; i < places.size(); ++i) mesh.triangles[places[i]] = triangles[i];
  mesh.triangles.insert(mesh.triangles.end(), new_triangles.begin(), new_triangles.end());
  mesh.vertices.insert(mesh.vertices.end(), new_vertices.begin(), new_vertices.end());
}

}  // namespace deliso
