// What is wrong with the mesh at the end of a run, and what is done about it.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "surface/base/sizes.h"
#include "surface/certificate/final_certificate.h"
#include "surface/certificate/finer_cubes.h"
#include "surface/certificate/geometry_check.h"
#include "surface/mesh/equal_vertices.h"
#include "surface/mesh/flat_triangles.h"
#include "surface/mesh/vertex_separation.h"
#include "surface/pipeline.h"
#include "surface/repair/finish/last_resort.h"
#include "surface/repair/lattice/cell_pieces.h"
#include "surface/shape/shape.h"

namespace deliso {

// Merges vertices that are written at one place, and flips triangles in one line, which may bring such together.
bool Pipeline::merge_in_world(SurfaceMesh& mesh) const {
  constexpr int kMostTimes = 16;
  bool is_changed = false;
  for (int time = 0; time < kMostTimes; ++time) {
    is_changed = merge_equal_vertices(places_in_world(mesh, *isosurface_), mesh) > 0 || is_changed;
    if (flip_flat_triangles(mesh) == 0) break;
    is_changed = true;
  }
  return is_changed;
}

// Whether no two triangles cross in mesh space: stage 2 has compared all, each slab those that meet it and the rest
// what it renewed; and the steps of the stage shape see all triangles near those that they replace. Steps towards
// stated sizes and finer cubes are not relied on for that.
bool Pipeline::is_compared() const {
  const SizeParameters& size = parameters_.size;
  return repairs(parameters_) && parameters_.algorithm == Algorithm::kTwoStage && !is_sized(parameters_) &&
         !size.max_edge && result_.repair.components_polygonized == 0 && result_.refine.meeting_pairs == 0;
}

// Rounded to coordinates of the world, vertices may be equal and triangles cross.
void Pipeline::look_in_world(SurfaceMesh& mesh) {
  const bool is_exact = is_exact_in_world(*isosurface_);
  if (!is_exact && merge_in_world(mesh)) {
    last_.geometry = check_geometry(mesh, *surface_, promise_);
  }
  if (!is_compared() || last_.crossing.meeting_pairs() > 0 || !is_exact) {
    last_.crossing = crossing_in_world(mesh, *isosurface_, options_.threads);
  }
}

// Where vertices of different parts are written at one place, their triangles touch.
void Pipeline::separate_in_world(SurfaceMesh& mesh) {
  if (!repairs(parameters_) || last_.crossing.meeting_pairs() == 0) return;
  SurfaceMesh next = mesh;
  if (separate_equal_vertices(places_in_world(mesh, *isosurface_), isosurface_->box(), next) == 0) return;
  MeshFaults faults = faults_of(next);
  if (faults.count() >= last_.count()) return;
  mesh = std::move(next);
  last_ = std::move(faults);
}

// A few triangles may cross where pinches come side by side, or once they are rounded. Finer cubes would take the place
// of all of their component, and are too many for one that fills a large volume.
void Pipeline::uncross_by_steps(SurfaceMesh& mesh) {
  constexpr int kMostRounds = 4;
  constexpr std::int64_t kFew = 1000;
  if (!repairs(parameters_) || !improves_shape(parameters_)) return;
  for (int round = 0; round < kMostRounds && !controls_.poll(); ++round) {
    if (last_.crossing.meeting_pairs() == 0 || last_.crossing.meeting_pairs() > kFew) return;
    std::vector<std::uint32_t> crossing;
    for (const auto* pairs : {&last_.crossing.crossing, &last_.crossing.touching}) {
      for (const TrianglePair& pair : *pairs) {
        crossing.push_back(pair.first);
        crossing.push_back(pair.second);
      }
    }
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    SurfaceMesh next = mesh;
    const ShapeStats shape_before = result_.shape;
    timed(result_.shape, [&] {
      replace_wrong_triangles(next, crossing, *surface_, shape_options(parameters_), controls_, result_.shape);
    });
    MeshFaults faults = faults_of(next);
    if (faults.count() >= last_.count()) {
      take_back_shape(shape_before);
      return;
    }
    mesh = std::move(next);
    last_ = std::move(faults);
  }
}

// What is wrong with the mesh in the end. Components with faults come from marching cubes that are finer where they
// have to be; from such as are finer everywhere where these have faults, too, and where cells are longer than wide.
void Pipeline::find_last_faults(SurfaceMesh& mesh) {
  timed(result_.certify_stage, [&] {
    look_in_world(mesh);
    find_places(mesh, last_);
  });
  separate_in_world(mesh);
  uncross_by_steps(mesh);
  if (!repairs(parameters_) || last_.count() == 0) return;
  // With a smaller error promised, cubes that are no smaller will mostly do.
  constexpr int kFinerRounds = 4, kNearerRounds = 2;
  constexpr double kTimes = 4, kLargest = 0.9;
  const double larger = std::max(promise_.max_distance, std::min(kTimes * promise_.max_distance, kLargest));
  const double cube = is_sized(parameters_) ? larger : promise_.max_distance;
  const SurfaceMesh first = mesh;
  const MeshFaults first_faults = last_;
  std::vector<bool> is_marked;
  std::int64_t most = 0;
  const int nearer_rounds = cell_pieces(*isosurface_) == GridFactors{1, 1, 1} ? kNearerRounds : 0;
  for (int round = 0; round < nearer_rounds + kFinerRounds && last_.count() > 0 && !controls_.poll(); ++round) {
    const ShapeStats shape_before = result_.shape;
    // Finer cubes take the place of what divided ones have not mended, and not of these.
    const bool is_anew = round == nearer_rounds;
    if (is_anew) is_marked.clear();
    SurfaceMesh next = is_anew ? first : mesh;
    const MeshFaults& faults_of_next = is_anew ? first_faults : last_;
    const std::int64_t replaced = timed(result_.repair, [&] {
      if (round >= nearer_rounds) {
        return replace_faulty_components(next, *surface_, faults_of_next, cube / (1 + round - nearer_rounds),
                                         is_marked);
      }
      return replace_by_nearer_cubes(next, *surface_, last_,
                                     {.max_distance = promise_.max_distance, .parts = 2 + round}, is_marked);
    });
    if (replaced == 0) break;
    MeshFaults faults = shaped_cubes(next);
    if (is_sized(parameters_)) bring_cubes_near(next, faults);
    if (faults.count() >= last_.count()) {
      take_back_shape(shape_before);
      continue;
    }
    mesh = std::move(next);
    last_ = std::move(faults);
    most = std::max(most, replaced);
  }
  result_.repair.components_polygonized += most;
  separate_in_world(mesh);
}

// What the stage says is of the mesh that is kept, but for its time.
void Pipeline::take_back_shape(const ShapeStats& before) {
  const double seconds = result_.shape.seconds;
  result_.shape = before;
  result_.shape.seconds = seconds;
}

// Finer cubes have slivers where the isosurface passes near a sample, and strips along closed walls that are nothing
// when written. Their faults after the steps that better their angles; if they had fewer before, after steps that keep
// to the distance promised at what the others have left too far; or as they were.
MeshFaults Pipeline::shaped_cubes(SurfaceMesh& mesh) {
  constexpr int kMostTimes = 3;
  merge_in_world(mesh);
  const ShapeStats shape_before = result_.shape;
  const KnownTriangles left_before = left_bad_;
  Observer* const observer = controls_.observer();
  controls_.set_observer(nullptr);  // the mesh may be taken back
  std::optional<MeshFaults> unshaped;
  std::vector<Vec3> missed;
  MeshFaults faults;
  for (int time = 0; time < kMostTimes; ++time) {
    SurfaceMesh shaped = mesh;
    if (time == 0) {
      improve(shaped, parameters_.shape.rounds);
    } else {
      improve_within_promise(shaped, missed, left_before);
    }
    merge_in_world(shaped);
    faults = faults_of(shaped);
    if (faults.count() > 0 && !unshaped) unshaped = faults_of(mesh);
    if (!unshaped || faults.count() <= unshaped->count()) {
      mesh = std::move(shaped);
      break;
    }
    const std::vector<Vec3>& now = faults.geometry.missed_points;
    missed.insert(missed.end(), now.begin(), now.end());
    take_back_shape(shape_before);
    const bool would_be_the_same = time > 0 && now.empty();
    faults = *unshaped;
    if (would_be_the_same) break;
  }
  controls_.set_observer(observer);
  return faults;
}

// Cubes a little too large leave a few triangles too far: steps bring these near. Smaller ones would have many times as
// many vertices everywhere.
void Pipeline::bring_cubes_near(SurfaceMesh& mesh, MeshFaults& faults) {
  constexpr std::int64_t kFew = 1000;
  const std::int64_t off = faults.geometry.mesh_off + std::ssize(faults.geometry.missed_points);
  if (off == 0 || off > kFew || off != faults.count() || !improves_shape(parameters_)) return;
  SurfaceMesh nearer = mesh;
  RepeatedCheck check(*surface_, promise_);
  take_steps_nearer(nearer, check, kFreeSteps);
  MeshFaults left = faults_of(nearer);
  if (left.count() >= faults.count()) return;
  mesh = std::move(nearer);
  faults = std::move(left);
}

MeshFaults Pipeline::faults_of(const SurfaceMesh& mesh) {
  return timed(result_.certify_stage, [&] {
    MeshFaults faults{
        check_geometry(mesh, *surface_, promise_), crossing_in_world(mesh, *isosurface_, options_.threads), {}, {}};
    find_places(mesh, faults);
    return faults;
  });
}

// Where the pieces of a mesh lie. Components left out on purpose may be without a piece.
void Pipeline::find_places(const SurfaceMesh& mesh, MeshFaults& faults) {
  faults.pieces = mesh_topology(mesh.points.size(), mesh.triangles, options_.threads);
  faults.places = {};
  if (!result_.build.bounds_a_solid) return;
  // Components within a rounding of a sample are told apart in mesh space, but not in the coordinates that are written.
  SurfaceMesh written;
  if (!is_exact_in_world(*isosurface_)) {
    written = mesh;
    written.points = places_in_world(mesh, *isosurface_);
    for (Vec3& p : written.points) p = from_world(p, *isosurface_);
  }
  faults.places = assignment_faults(written.points.empty() ? mesh : written, faults.pieces, *surface_);
}

}  // namespace deliso
