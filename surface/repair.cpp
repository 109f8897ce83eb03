#include "surface/repair.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/founded_signs.h"
#include "surface/poles.h"
#include "surface/polygonized_components.h"
#include "surface/raised_cells.h"
#include "surface/sample_lattice.h"
#include "surface/sign_rules.h"
#include "surface/trouble.h"

namespace deliso {

namespace {

constexpr std::array<SignRule, 4> kRules = {SignRule::kCentroidWithRing, SignRule::kCentroid,
                                            SignRule::kCentroidWhereOpposed, SignRule::kCircumcenter};

class Repair {
 public:
  Repair(const ScalarGrid& grid, const IsosurfaceTopology& topology, std::unique_ptr<SignedDelaunay> restricted,
         RepairStats& stats)
      : grid_(grid),
        isosurface_(restricted->isosurface()),
        topology_(topology),
        stats_(stats),
        restricted_(std::move(restricted)),
        lattice_(grid, isosurface_.isovalue(), topology),
        raised_(grid, isosurface_),
        done_(topology.components.size(), false),
        mixed_(topology.components.size()) {}

  SurfaceMesh run(std::int32_t max_rounds, Controls& controls);

 private:
  struct Sample {
    Vec3 point;             // in mesh space
    std::uint64_t key = 0;  // of a lattice sample; 0 for a free one
  };

  void take_samples();
  void resample();
  void triangulate();
  void try_rules();
  MatchedMesh assemble();
  void keep_agreeing(const MatchedMesh& mesh);
  void keep_mixed();
  void keep_polygonized();
  [[nodiscard]] bool is_done() const {
    return std::all_of(done_.begin(), done_.end(), [](bool done) { return done; });
  }

  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  const IsosurfaceTopology& topology_;
  RepairStats& stats_;
  std::unique_ptr<SignedDelaunay> restricted_;
  SampleLattice lattice_;
  RaisedCells raised_;
  std::vector<Sample> samples_;
  MatchedMesh mesh_;                // the best of the current round
  std::vector<bool> done_;          // of each exact component: kept_ holds its piece
  std::vector<SurfaceMesh> mixed_;  // of each: the first piece that agrees but is mixed with another component
  SurfaceMesh kept_;
};

SurfaceMesh Repair::run(std::int32_t max_rounds, Controls& controls) {
  take_samples();
  overturn_unfounded_signs(*restricted_, grid_);
  mesh_ = assemble();
  stats_.vertices_before = static_cast<std::int64_t>(mesh_.built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_.match.agreement.begin(), mesh_.match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
  keep_agreeing(mesh_);
  for (std::int32_t round = 1; round <= max_rounds && !is_done() && !controls.stopped(); ++round) {
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_.match.error));
    raised_.raise(cells_in_trouble(grid_, topology_, *restricted_, mesh_, raised_, done_));
    resample();
    triangulate();
    try_rules();
    stats_.rounds = round;
  }
  keep_mixed();
  keep_polygonized();
  stats_.vertices_after = static_cast<std::int64_t>(kept_.points.size());
  return std::move(kept_);
}

void Repair::take_samples() {
  const auto& points = restricted_->delaunay().points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!restricted_->is_virtual(VertexId(i))) samples_.push_back({points[i], 0});
  }
}

// Free samples in raised cells go, lattice samples come. Free samples on the box stay: they carry its boundary curves.
void Repair::resample() {
  std::vector<std::uint64_t> have;
  std::erase_if(samples_, [&](const Sample& sample) {
    const bool goes = sample.key == 0 && raised_.is_raised(raised_.name(raised_.cell_of(sample.point))) &&
                      !SignedDelaunay::on_box(isosurface_.box(), sample.point);
    if (!goes && sample.key != 0) have.push_back(sample.key);
    return goes;
  });
  std::sort(have.begin(), have.end());
  std::vector<LatticeSample> found;
  for (const auto& [name, level] : raised_.levels()) lattice_.append(raised_.cell(name), level, found);
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  std::uint64_t last = 0;
  for (const LatticeSample& sample : found) {
    if (sample.key == last || std::binary_search(have.begin(), have.end(), sample.key)) continue;
    last = sample.key;
    samples_.push_back({scaled(sample.point, isosurface_.step()), sample.key});
  }
}

void Repair::triangulate() {
  std::vector<Vec3> points;
  points.reserve(samples_.size());
  for (const Sample& sample : samples_) points.push_back(sample.point);
  restricted_.reset();
  restricted_ = std::make_unique<SignedDelaunay>(isosurface_, points);
}

// One rule after another until every component is done; the rule with the smallest error stays.
void Repair::try_rules() {
  const auto apply = [&](SignRule rule) {
    take_signs(*restricted_, grid_, raised_, rule);
    overturn_unfounded_signs(*restricted_, grid_);
  };
  SignRule best = kRules.front();
  for (const SignRule rule : kRules) {
    apply(rule);
    MatchedMesh attempt = assemble();
    keep_agreeing(attempt);
    if (rule == kRules.front() || attempt.match.error < mesh_.match.error) {
      mesh_ = std::move(attempt);
      best = rule;
    }
    if (is_done()) return;
  }
  apply(best);
}

// The mesh, its pole heights and its match with the exact components.
MatchedMesh Repair::assemble() {
  MatchedMesh mesh{build_triangle_mesh(*restricted_), {}, {}};
  const std::vector<double> heights = compute_poles(*restricted_);
  const Vec3& step = isosurface_.step();
  for (const VertexId v : mesh.built.vertex_of) {
    mesh.built.mesh.pole_heights.push_back(heights[v.index()]);
    const Vec3& p = restricted_->delaunay().point(v);
    const Vec3 index_point{p.x / step.x, p.y / step.y, p.z / step.z};
    mesh.component.push_back(component_of(grid_, isosurface_.isovalue(), topology_, index_point).value_or(0));
  }
  mesh.match = match_components(mesh.built.mesh, mesh.component, topology_.components);
  return mesh;
}

// A component keeps the first main piece that agrees with it; strays beside it are dropped.
void Repair::keep_agreeing(const MatchedMesh& mesh) {
  std::vector<bool> wanted(mesh.match.pieces.size(), false);
  for (std::size_t c = 0; c < done_.size(); ++c) {
    const Agreement agreement = mesh.match.agreement[c];
    if (done_[c] || agreement == Agreement::kNone) continue;
    if (agreement == Agreement::kMixed) {
      if (!mixed_[c].points.empty()) continue;
      std::vector<bool> alone(mesh.match.pieces.size(), false);
      alone[mesh.match.main_piece[c]] = true;
      append_pieces(mesh.built.mesh, mesh.match.piece_of, alone, mixed_[c]);
      continue;
    }
    wanted[mesh.match.main_piece[c]] = true;
    done_[c] = true;
    stats_.components_stray += agreement == Agreement::kWithStrays ? 1 : 0;
  }
  append_pieces(mesh.built.mesh, mesh.match.piece_of, wanted, kept_);
}

void Repair::keep_mixed() {
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (done_[c] || mixed_[c].points.empty()) continue;
    const std::vector<std::uint32_t> all(mixed_[c].points.size(), 0);
    append_pieces(mixed_[c], all, {true}, kept_);
    done_[c] = true;
    ++stats_.components_mixed;
  }
}

void Repair::keep_polygonized() {
  if (is_done()) return;
  stats_.components_polygonized = std::count(done_.begin(), done_.end(), false);
  const SurfaceMesh polygonized = polygonized_components(grid_, isosurface_, topology_, done_);
  const std::vector<std::uint32_t> all(polygonized.points.size(), 0);
  append_pieces(polygonized, all, {true}, kept_);
}

}  // namespace

SurfaceMesh repair(const ScalarGrid& grid, const IsosurfaceTopology& topology,
                   std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls,
                   RepairStats& stats) {
  return Repair(grid, topology, std::move(restricted), stats).run(max_rounds, controls);
}

}  // namespace deliso
