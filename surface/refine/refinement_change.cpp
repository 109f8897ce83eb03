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

void RefineLoop::Start::keep_vertex(std::uint32_t v, const RefinementMesh& mesh) {
  if (v >= vertex_count_) return;
  is_moved_.resize(vertex_count_);
  if (is_moved_[v]) return;
  is_moved_[v] = true;
  moved_.push_back({v, mesh.vertices[v].point, mesh.vertices[v].clearance});
}

RefinementChange RefineLoop::Start::restore(RefinementMesh& mesh) {
  RefinementChange change;
  change.new_triangles.assign(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(is_kept_.size()),
                              mesh.triangles.end());
  change.new_vertices.assign(mesh.vertices.begin() + static_cast<std::ptrdiff_t>(vertex_count_), mesh.vertices.end());
  for (std::size_t i = 0; i < places_.size(); ++i) std::swap(mesh.triangles[places_[i]], triangles_[i]);
  for (MovedVertex& moved : moved_) {
    std::swap(mesh.vertices[moved.vertex].point, moved.point);
    std::swap(mesh.vertices[moved.vertex].clearance, moved.clearance);
  }
  change.moved = std::move(moved_);
  change.places = std::move(places_);
  change.triangles = std::move(triangles_);
  mesh.triangles.resize(is_kept_.size());
  mesh.vertices.resize(vertex_count_);
  mesh.forget_attempts();
  return change;
}

void RefinementChange::redo(RefinementMesh& mesh) const {
  for (std::size_t i = 0; i < places.size(); ++i) mesh.triangles[places[i]] = triangles[i];
  for (const MovedVertex& old : moved) {
    mesh.vertices[old.vertex].point = old.point;
    mesh.vertices[old.vertex].clearance = old.clearance;
  }
  mesh.triangles.insert(mesh.triangles.end(), new_triangles.begin(), new_triangles.end());
  mesh.vertices.insert(mesh.vertices.end(), new_vertices.begin(), new_vertices.end());
}

}  // namespace deliso
