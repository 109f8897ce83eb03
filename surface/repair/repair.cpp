#include "surface/repair/repair.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surface/intersection/self_intersection.h"
#include "surface/repair/finish/foreign_vertices.h"
#include "surface/repair/finish/inverted_umbrellas.h"
#include "surface/repair/finish/marching_cubes_fallback.h"
#include "surface/repair/finish/missed_crossings.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/rounds.h"

namespace deliso {

namespace {

// More rounds for what the mesh leaves out or where it crosses, though its topology is right, begin so often at most.
constexpr int kMostReopenings = 2;
// Crossing triangles are looked for around so many of their pairs.
constexpr std::size_t kMostPairs = 256;

class Repair {
 public:
  Repair(const ExactSurfaceCache& facts, std::unique_ptr<SignedDelaunay> restricted, int threads, RepairStats& stats)
      : facts_(facts),
        isosurface_(restricted->isosurface()),
        threads_(threads),
        stats_(stats),
        rounds_(facts, std::move(restricted), threads, stats) {}

  SurfaceMesh run(std::int32_t max_rounds, Controls& controls);

 private:
  // What rounds have led to.
  struct Ending {
    AssembledMesh result;
    std::vector<bool> is_polygonized;  // of each component in it
    std::vector<Box3> dents;           // left in it
    bool is_apart = false;
    RepairStats stats;
  };

  bool mend(std::int32_t max_rounds, Controls& controls);
  void finish(bool is_assembled, std::int32_t max_rounds, Controls& controls);
  void mend_crossing(std::int32_t max_rounds, Controls& controls);
  void mend_left_out(std::int32_t max_rounds, Controls& controls);
  std::optional<Ending> mend_around(std::span<const std::uint32_t> crossings, std::int32_t max_rounds,
                                    Controls& controls);
  [[nodiscard]] SelfIntersections crossing_triangles() const {
    return self_intersections(result_.mesh.points, result_.mesh.triangles, kMostPairs, threads_);
  }
  [[nodiscard]] std::vector<std::uint32_t> left_out(std::span<const Box3> boxes) const {
    return missed_crossings(result_.mesh, boxes, facts_.grid(), facts_.topology(), isosurface_.step(), threads_);
  }
  Ending take_ending();
  void return_to(Ending ending);
  bool ends_without_intruders();
  bool assemble(const ComponentSelection& kept);
  void polygonize_rest();
  bool take_intruders_out();

  const ExactSurfaceCache& facts_;
  const Isosurface& isosurface_;
  int threads_;
  RepairStats& stats_;
  Rounds rounds_;
  AssembledMesh result_;              // at last
  std::vector<bool> is_polygonized_;  // of each component in it
  std::vector<Box3> dents_;           // left in it
  bool is_apart_ = false;             // its triangles are known not to cross; taking dents out keeps that
};

SurfaceMesh Repair::run(std::int32_t max_rounds, Controls& controls) {
  if (controls.stopped()) return rounds_.as_it_is();
  finish(mend(max_rounds, controls), max_rounds, controls);
  mend_crossing(max_rounds, controls);
  mend_left_out(max_rounds, controls);
  rounds_.end();
  SurfaceMesh& mesh = result_.mesh;
  // Mixed pieces may have come to lie on all of another component, or on most of it.
  const bool may_be_misplaced = stats_.components_mixed > 0 && !controls.poll();
  if (may_be_misplaced && polygonize_misplaced_pieces(mesh, facts_, isosurface_, is_polygonized_, threads_)) {
    is_apart_ = false;
  }
  if (!is_apart_) polygonize_crossing_pieces(mesh, facts_, isosurface_, is_polygonized_, threads_, controls);
  stats_.components_polygonized = std::count(is_polygonized_.begin(), is_polygonized_.end(), true);
  stats_.vertices_after = static_cast<std::int64_t>(mesh.points.size());
  return std::move(mesh);
}

// Rounds until every component is done, or nothing is left but what taking vertices out mends: true when that is done.
bool Repair::mend(std::int32_t max_rounds, Controls& controls) {
  return rounds_.mend(
      max_rounds, [this] { return ends_without_intruders(); }, controls);
}

// The mesh of what has been mended, without its dents. What another round would need stays, if there may be one.
void Repair::finish(bool is_assembled, std::int32_t max_rounds, Controls& controls) {
  if (!is_assembled) {
    const ComponentSelection& kept = rounds_.kept();
    if (!rounds_.is_done() || !rounds_.may_go_on(max_rounds) || controls.poll()) rounds_.end();
    if (!assemble(kept)) polygonize_rest();
    if (stats_.components_mixed > 0 && !controls.poll()) take_intruders_out();
  }
  stats_.inverted_umbrellas_removed = 0;
  if (controls.poll()) return;
  auto [removed, left] = remove_inverted_umbrellas(result_.mesh, isosurface_, threads_);
  stats_.inverted_umbrellas_removed = removed;
  dents_ = std::move(left);
}

// More rounds where the topology is right and yet triangles cross; unless they do not help.
void Repair::mend_crossing(std::int32_t max_rounds, Controls& controls) {
  if (is_apart_ || !rounds_.may_go_on(max_rounds) || controls.poll()) return;
  SelfIntersections found = crossing_triangles();
  is_apart_ = found.crossing_pairs == 0;
  for (int i = 0; i < kMostReopenings && rounds_.may_go_on(max_rounds) && !controls.poll(); ++i) {
    const std::vector<std::uint32_t> crossings = rounds_.crossings_at(found.crossing, result_.mesh);
    if (crossings.empty()) return;
    std::optional<Ending> before = mend_around(crossings, max_rounds, controls);
    if (!before) return;
    if (is_apart_) return;
    SelfIntersections left = crossing_triangles();
    if (left.crossing_pairs >= found.crossing_pairs) return return_to(*std::move(before));
    found = std::move(left);
    is_apart_ = found.crossing_pairs == 0;
  }
}

// More rounds where the topology is right and yet the mesh leaves parts of the surface out; unless they do not help.
void Repair::mend_left_out(std::int32_t max_rounds, Controls& controls) {
  for (int i = 0; i < kMostReopenings && rounds_.may_go_on(max_rounds) && !controls.poll(); ++i) {
    const std::vector<std::uint32_t> crossings = left_out(dents_);
    if (crossings.empty()) return;
    std::optional<Ending> before = mend_around(crossings, max_rounds, controls);
    if (!before) return;
    // Where dents were and where they are.
    std::vector<Box3> boxes = before->dents;
    boxes.insert(boxes.end(), dents_.begin(), dents_.end());
    if (left_out(boxes).size() >= crossings.size()) return return_to(*std::move(before));
  }
}

// Rounds that begin around some crossings. What there was before, if they have led to a mesh that is right, too; else
// nothing, and all is as it was.
std::optional<Repair::Ending> Repair::mend_around(std::span<const std::uint32_t> crossings, std::int32_t max_rounds,
                                                  Controls& controls) {
  Ending before = take_ending();
  rounds_.mend_around(crossings, controls);
  const bool is_assembled = mend(max_rounds, controls);
  const bool is_done = is_assembled || rounds_.is_done();
  if (is_done) finish(is_assembled, max_rounds, controls);
  if (is_done && !controls.poll() && is_polygonized_ == before.is_polygonized) return before;
  return_to(std::move(before));
  return std::nullopt;
}

Repair::Ending Repair::take_ending() {
  Ending ending{std::exchange(result_, {}), is_polygonized_, std::exchange(dents_, {}), std::exchange(is_apart_, false),
                stats_};
  stats_.foreign_vertices_removed = stats_.inverted_umbrellas_removed = 0;
  return ending;
}

void Repair::return_to(Ending ending) {
  const std::int64_t rounds = stats_.rounds;
  result_ = std::move(ending.result);
  is_polygonized_ = std::move(ending.is_polygonized);
  dents_ = std::move(ending.dents);
  is_apart_ = ending.is_apart;
  stats_ = ending.stats;
  stats_.rounds = rounds;
}

// Whether nothing is wrong any more but that components have vertices of others, and these can be taken out. Where it
// is the crossing of triangles that is wrong, the next round is to sample around them.
bool Repair::ends_without_intruders() {
  if (!rounds_.is_done_but_for_mixing()) return false;
  const bool is_whole = assemble(rounds_.kept());
  if (is_whole && take_intruders_out()) return true;
  if (is_whole) rounds_.take_along(rounds_.crossings_at(crossing_triangles().crossing, result_.mesh));
  result_ = {};
  is_apart_ = false;
  stats_.foreign_vertices_removed = 0;
  return false;
}

// Every component as the latest mesh that agrees with it has it, so that most come from one triangulation; strays are
// dropped. Whether that is all of them.
bool Repair::assemble(const ComponentSelection& kept) {
  result_ = kept.assemble(is_polygonized_, isosurface_.box(), threads_, stats_);
  return std::find(is_polygonized_.begin(), is_polygonized_.end(), true) == is_polygonized_.end();
}

void Repair::polygonize_rest() {
  const auto& [polygonized, component] = facts_.polygonized();
  append_pieces(polygonized, component, is_polygonized_, result_.mesh);
  std::copy_if(component.begin(), component.end(), std::back_inserter(result_.component),
               [&](std::uint32_t c) { return c < is_polygonized_.size() && is_polygonized_[c]; });
}

// What components taken with vertices of others have of them; unless that is what makes triangles cross. Whether none
// is left and nothing crosses.
bool Repair::take_intruders_out() {
  const auto crosses = [&](const SurfaceMesh& mesh) {
    return self_intersections(mesh.points, mesh.triangles, 0, threads_).crossing_pairs > 0;
  };
  SurfaceMesh without = result_.mesh;
  const auto [removed, left] = remove_foreign_vertices(without, result_.component);
  if (removed == 0 && left > 0) return false;
  is_apart_ = !crosses(without);
  if (removed == 0) return is_apart_;
  if (!is_apart_ && !crosses(result_.mesh)) {
    is_apart_ = true;  // as it is
    return false;
  }
  stats_.foreign_vertices_removed = removed;
  result_ = {std::move(without), {}};
  return left == 0 && is_apart_;
}

}  // namespace

SurfaceMesh repair(const ExactSurfaceCache& facts, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
                   int threads, Controls& controls, RepairStats& stats) {
  return Repair(facts, std::move(restricted), threads, stats).run(max_rounds, controls);
}

}  // namespace deliso
