// A run after RefineGeom: better angles, the distance promised, the certificate.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "delaunay/triangle_contact.h"
#include "surface/base/sizes.h"
#include "surface/certificate/final_certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/certificate/kept_components.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/mesh/triangle_area.h"
#include "surface/pipeline.h"
#include "surface/refine/refine.h"
#include "surface/shape/shape.h"

namespace deliso {

void Pipeline::finish(SurfaceMesh& mesh, const RefineOptions& options) {
  if (parameters_.size.max_edge) limit_edges(mesh, options);
  improve(mesh, parameters_.shape.rounds);
  // Of a run that was stopped no distance is promised, and its few large triangles would take long to measure.
  if (!parameters_.certify || controls_.stopped()) return;
  const bool was_near = !is_sized(parameters_) && come_near(mesh, options);
  // What is off within cells only is reached as where an error is stated.
  if (is_sized(parameters_) || (promise_.within_cells && !last_.geometry.is_near())) {
    if (!refine_to_error(mesh, options)) {
      take_nearer_cubes(mesh);
      begin_again(mesh);
    }
  }
  if (!is_sized(parameters_) && promise_.within_cells && !was_near && last_.geometry.is_near()) improve_near(mesh);
  if (drops_components(parameters_.components) && !controls_.stopped()) drop_components(mesh);
  if (is_sized(parameters_) && !controls_.stopped()) fit_sizes(mesh, options);
  if (controls_.stopped()) return;
  find_last_faults(mesh);
  // Finer cubes of a component that fills a large volume would be too many. There, as where an error is stated, stage 1
  // runs again with more samples near what is too far.
  if (last_.geometry.is_near() || is_sized(parameters_) || controls_.stopped()) return;
  begin_again(mesh);
  find_last_faults(mesh);
}

// Components left out on purpose count no more: neither the mesh nor the certificate has them.
void Pipeline::drop_components(SurfaceMesh& mesh) {
  timed(result_.certify_stage, [&] {
    set_side_adjacency(mesh);
    const MeasuredPieces measured = measure_pieces(mesh, inside_of(parameters_.field));
    const std::vector<DropCause> causes = pieces_to_drop(mesh, measured, parameters_.components);
    std::vector<bool> is_gone(mesh.triangles.size(), false);
    std::vector<std::vector<std::uint32_t>> gone(causes.size());
    for (std::uint32_t t = 0; t < is_gone.size(); ++t) {
      is_gone[t] = causes[measured.piece_of[t]] != DropCause::kNone;
      if (is_gone[t]) gone[measured.piece_of[t]].push_back(t);
    }
    surface_->is_dropped.assign(topology_.components.size(), 0);
    for (std::size_t piece = 0; piece < causes.size(); ++piece) {
      if (causes[piece] == DropCause::kNone) continue;
      result_.dropped.push_back({measured.pieces[piece], causes[piece]});
      const auto component = most_frequent(components_at(mesh, vertices_of(mesh, gone[piece]), *surface_));
      if (component) surface_->is_dropped[*component] = 1;
    }
    const auto& is_dropped = surface_->is_dropped;
    result_.dropped_components = std::count(is_dropped.begin(), is_dropped.end(), std::uint8_t{1});
    drop_triangles(mesh, is_gone);
    if (mesh.triangles.empty()) {
      throw InputError("components: all " + std::to_string(causes.size()) +
                       " components of the isosurface would be left out, expected one at least to be kept");
    }
    std::stable_sort(result_.dropped.begin(), result_.dropped.end(),
                     [](const DroppedPiece& a, const DroppedPiece& b) { return a.piece.area > b.piece.area; });
    last_.geometry = check_geometry(mesh, *surface_, promise_);
  });
}

// What the criteria leave badly shaped, where insertions are refused and at or below r_min; not in the paper.
void Pipeline::improve(SurfaceMesh& mesh, int most_rounds) {
  if (!improves_shape(parameters_) || controls_.stopped()) return;
  controls_.enter("shape");
  timed(result_.shape, [&] {
    ShapeOptions options = shape_options(parameters_);
    options.rounds = std::min(options.rounds, most_rounds);
    improve_shape(mesh, *surface_, options, controls_, result_.shape, left_bad_);
    if (controls_.observer() != nullptr) controls_.observer()->reshaped(mesh);
  });
}

// The angles of what has been brought nearer than a voxel, where no decimation follows. Steps may leave points of the
// isosurface too far: then they begin again, and keep to these.
void Pipeline::improve_near(SurfaceMesh& mesh) {
  constexpr int kMostTimes = 3;
  const ShapeStats shape_before = result_.shape;
  std::vector<Vec3> missed;
  for (int time = 0; time < kMostTimes && !controls_.poll(); ++time) {
    SurfaceMesh better = mesh;
    improve_within_promise(better, missed);
    GeometryCheck now = timed(result_.certify_stage, [&] { return check_geometry(better, *surface_, promise_); });
    if (now.is_near()) {
      mesh = std::move(better);
      last_.geometry = std::move(now);
      return;
    }
    take_back_shape(shape_before);
    missed.insert(missed.end(), now.missed_points.begin(), now.missed_points.end());
  }
}

// Refinement gives the better triangles where much is far off, but it measures all of the mesh again and refines places
// that are near. So a few that are far are left to steps, if these bring all of them near.
// Returns whether nothing was far.
bool Pipeline::come_near(SurfaceMesh& mesh, const RefineOptions& options) {
  constexpr std::int64_t kFew = 1000, kShare = 100;  // at most, and at most one for so many triangles
  RepeatedCheck check(*surface_, promise_);
  last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
  if (last_.geometry.is_near()) return true;
  const std::int64_t off = last_.geometry.mesh_off + std::ssize(last_.geometry.missed_points);
  if (off <= std::min(kFew, std::ssize(mesh.triangles) / kShare)) bring_near_by_steps(mesh, check);
  if (!last_.geometry.is_near()) refine_by_distance(mesh, options, check);
  bring_near_by_steps(mesh, check);
  return false;
}

// Where the paper's criteria leave the mesh farther from the isosurface than promised, refinement goes on by distance;
// not without repair, as in the paper. What is promised is known afterwards.
void Pipeline::refine_by_distance(SurfaceMesh& mesh, RefineOptions options, RepeatedCheck& check) {
  constexpr int kMostRounds = 6, kCautiousRounds = 2;  // of shape: what it has cut off would be cut off again
  constexpr double kFraction = 0.75;  // of the distance promised: h is measured at one point of each triangle
  const bool may_refine = repairs(parameters_) && parameters_.algorithm == Algorithm::kTwoStage;
  options.epsilon2 = std::numeric_limits<double>::infinity();
  options.max_distance = std::min(options.max_distance, kFraction * promise_.max_distance);
  std::int64_t off_before = 0;
  for (int round = 0; round < kMostRounds && may_refine && !last_.geometry.is_near() && !controls_.poll(); ++round) {
    const std::int64_t off = last_.geometry.mesh_off + std::ssize(last_.geometry.missed_points);
    if (round > 0 && off > off_before / 2) return;  // finer cubes are to replace what is off
    off_before = off;
    const std::int64_t before = result_.refine.insertions;
    timed(result_.refine, [&] {
      set_side_adjacency(mesh);
      mesh.pole_heights.assign(mesh.points.size(), isosurface_->box().diagonal());
      options.coverage_targets = last_.geometry.missed_points;
      refine_geometry(mesh, *isosurface_, options, controls_, result_.refine);
    });
    if (round == 0) improve(mesh, kCautiousRounds);
    last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
    if (result_.refine.insertions == before) return;
  }
}

void Pipeline::drop_crossings() {
  UnwrittenArray<EdgeCrossing>().swap(topology_.crossings);
  topology_.index = {};
  release_free_memory();
}

void Pipeline::certify(SurfaceMesh mesh) {
  // Elsewhere the last look for faults has found them.
  if (parameters_.certify && (!result_.build.bounds_a_solid || controls_.stopped())) find_places(mesh, last_);
  double squared_longest = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    squared_longest = std::max(squared_longest, squared_longest_edge(mesh, t));
  }
  result_.longest_edge = std::max(result_.longest_edge, std::sqrt(squared_longest));
  std::int64_t without_area = count_without_area(mesh);
  if (without_area > 0 && !controls_.stopped() && merge_in_world(mesh)) {
    without_area = count_without_area(mesh);
    if (parameters_.certify && result_.build.bounds_a_solid) last_ = faults_of(mesh);
  }
  if (result_.shape.seconds > 0) {
    count_bad_triangles(mesh, shape_options(parameters_), options_.threads, result_.shape);
  }
  if (controls_.observer() != nullptr) controls_.observer()->finished(mesh);
  result_.mesh = to_world(std::move(mesh), *isosurface_);
  SurfaceMesh places;
  for (const DroppedPiece& dropped : result_.dropped) places.points.push_back(dropped.piece.at);
  const std::vector<Vec3> places_in_world = to_world(std::move(places), *isosurface_).points;
  for (std::size_t i = 0; i < places_in_world.size(); ++i) result_.dropped[i].piece.at = places_in_world[i];
  SurfaceMesh centroids;
  for (const BadTriangle& bad : result_.shape.worst) centroids.points.push_back(bad.centroid);
  const std::vector<Vec3> in_world = to_world(std::move(centroids), *isosurface_).points;
  for (std::size_t i = 0; i < in_world.size(); ++i) result_.shape.worst[i].centroid = in_world[i];
  if (!parameters_.certify) return;
  drop_crossings();
  if (!result_.dropped.empty()) keep_components(topology_, surface_->is_dropped);
  result_.certificate = final_certificate(last_.pieces, topology_, last_.places, result_.build.bounds_a_solid);
  if (!result_.build.bounds_a_solid) return;
  PromiseFigures figures;
  figures.triangles = static_cast<std::int64_t>(result_.mesh.triangles.size());
  figures.is_manifold = result_.certificate.manifold;
  figures.misoriented_edges = result_.certificate.oriented ? 0 : 1;
  figures.topology = result_.certificate.verdict;
  if (controls_.stopped()) {
    // Checks end with the run: what they have found by then says nothing of the rest.
    result_.certificate.broken = broken_promises(figures, stated());
    result_.certificate.broken.push_back(unchecked_when_stopped());
    return;
  }
  figures.reversed_components = last_.geometry.reversed_components;
  figures.off_box_edges = static_cast<std::int64_t>(last_.geometry.off_box_edges.size());
  figures.crossing_pairs = last_.crossing.crossing_pairs;
  figures.touching_pairs = last_.crossing.touching_pairs;
  figures.zero_area_triangles = std::max(without_area, last_.crossing.zero_area_triangles);
  figures.vertices_off = last_.geometry.vertices_off;
  figures.mesh_off = last_.geometry.mesh_off;
  figures.isosurface_off = static_cast<std::int64_t>(last_.geometry.missed_points.size());
  result_.certificate.broken = broken_promises(figures, stated());
  if (options_.observer != nullptr) options_.observer->certified(figures, stated());
}

}  // namespace deliso
