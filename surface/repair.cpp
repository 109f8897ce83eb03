#include "surface/repair.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/coverage.h"
#include "surface/founded_signs.h"
#include "surface/poles.h"
#include "surface/polygonized_components.h"
#include "surface/raised_cells.h"
#include "surface/sample_lattice.h"
#include "surface/sign_rules.h"
#include "surface/sweep_difference.h"
#include "surface/trouble.h"

namespace deliso {

namespace {

// What sweeps find counts unless it is more than kMostPlaces; in the first round, when other signs tell more, unless it
// is more than kFewPlaces.
constexpr std::size_t kFewPlaces = 30;
constexpr std::size_t kMostPlaces = 512;
// A surface of so many crossings is polygonized as a whole when one of its components has to be.
constexpr std::size_t kSmallSurface = 100000;
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
        best_(topology.components.size(), Agreement::kNone) {}

  SurfaceMesh run(std::int32_t max_rounds, Controls& controls);

 private:
  struct Sample {
    Vec3 point;             // in mesh space
    std::uint64_t key = 0;  // of a lattice sample; 0 for a free one
  };

  void take_samples();
  void resample();
  void triangulate();
  void look_around();
  bool try_rule(SignRule rule);
  void try_rules();
  MatchedMesh assemble();
  void find_missing_parts(MatchedMesh& mesh);
  [[nodiscard]] std::uint32_t component_at(const Vec3& p) const;
  std::vector<Places> places_of_difference(std::int32_t round);
  const PolygonizedSurface& polygonized();
  void keep(const MatchedMesh& mesh);
  SurfaceMesh assemble_kept();
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
  std::vector<bool> at_circumcenters_;              // signs, by slot of the tetrahedron
  std::vector<std::uint32_t> component_of_vertex_;  // of the triangulation
  std::vector<Sample> samples_;
  MatchedMesh mesh_;             // the latest
  std::vector<bool> done_;       // of each exact component: needs no more work
  std::vector<Agreement> best_;  // of each: the best, kWithStrays at most, reached by some mesh in history_
  std::optional<PolygonizedSurface> polygonized_;  // made when first needed
  std::vector<MatchedMesh> history_;               // meshes that brought a component further
};

SurfaceMesh Repair::run(std::int32_t max_rounds, Controls& controls) {
  take_samples();
  look_around();
  overturn_unfounded_signs(*restricted_, grid_);
  mesh_ = assemble();
  stats_.vertices_before = static_cast<std::int64_t>(mesh_.built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_.match.agreement.begin(), mesh_.match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
  keep(mesh_);
  for (std::int32_t round = 1; round <= max_rounds && !is_done() && !controls.stopped(); ++round) {
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_.match.error));
    raised_.raise(cells_in_trouble(
        {grid_, topology_, *restricted_, mesh_, raised_, component_of_vertex_, done_, places_of_difference(round)}));
    if (round == 1 && try_rule(SignRule::kCircumcenter)) break;  // new signs may do without new samples
    resample();
    triangulate();
    try_rules();
    stats_.rounds = round;
  }
  SurfaceMesh kept = assemble_kept();
  stats_.vertices_after = static_cast<std::int64_t>(kept.points.size());
  return kept;
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
  look_around();
}

// What all rules need of a new triangulation.
void Repair::look_around() {
  at_circumcenters_ = restricted_->signs();
  const Tetrahedralization& delaunay = restricted_->delaunay();
  component_of_vertex_.assign(delaunay.vertex_count(), 0);
  for (std::size_t i = 0; i < component_of_vertex_.size(); ++i) {
    if (!restricted_->is_virtual(VertexId(i))) component_of_vertex_[i] = component_at(delaunay.point(VertexId(i)));
  }
}

// Takes signs by a rule and keeps the mesh if it helps; true when no component is left.
bool Repair::try_rule(SignRule rule) {
  take_signs(*restricted_, grid_, raised_, at_circumcenters_, rule);
  overturn_unfounded_signs(*restricted_, grid_);
  mesh_ = assemble();
  keep(mesh_);
  return is_done();
}

// One rule after another until every component is done; the mesh with the smallest error stays.
void Repair::try_rules() {
  MatchedMesh best;
  std::vector<bool> signs;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const SignRule rule : kRules) {
    if (try_rule(rule)) return;
    if (mesh_.match.error >= least) continue;
    least = mesh_.match.error;
    best = std::move(mesh_);
    signs = restricted_->signs();
  }
  mesh_ = std::move(best);
  restricted_->set_signs(signs);
}

// The mesh and its match with the exact components.
MatchedMesh Repair::assemble() {
  MatchedMesh mesh{build_triangle_mesh(*restricted_), {}, {}};
  for (const VertexId v : mesh.built.vertex_of) mesh.component.push_back(component_of_vertex_[v.index()]);
  mesh.match = match_components(mesh.built.mesh, mesh.component, topology_.components);
  find_missing_parts(mesh);
  return mesh;
}

std::uint32_t Repair::component_at(const Vec3& p) const {
  const Vec3& step = isosurface_.step();
  const Vec3 index_point{p.x / step.x, p.y / step.y, p.z / step.z};
  return component_of(grid_, isosurface_.isovalue(), topology_, index_point).value_or(0);
}

// A piece can have the right topology and still lack a branch that was cut off. Samples that the main pieces leave out
// tell: each must have one of their triangles near.
void Repair::find_missing_parts(MatchedMesh& mesh) {
  ComponentMatch& match = mesh.match;
  const auto on_main_piece = [&](std::uint32_t v) {
    const std::uint32_t piece = match.piece_of[v];
    return piece != kNoPiece && match.main_piece[match.pieces[piece].component] == piece;
  };
  std::vector<bool> used(restricted_->delaunay().vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.component.size(); ++v) {
    if (on_main_piece(v)) used[mesh.built.vertex_of[v].index()] = true;
  }
  std::vector<Vec3> left_out;
  std::vector<std::uint32_t> component;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_->is_virtual(VertexId(i))) continue;
    if (match.agreement[component_of_vertex_[i]] <= Agreement::kPartial) continue;
    left_out.push_back(restricted_->delaunay().point(VertexId(i)));
    component.push_back(component_of_vertex_[i]);
  }
  const std::vector<bool> covered = covered_points(
      left_out, mesh.built.mesh, [&](std::uint32_t t) { return on_main_piece(mesh.built.mesh.triangles[t][0]); });
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    Agreement& agreement = match.agreement[component[i]];
    if (covered[i] || agreement == Agreement::kPartial) continue;
    agreement = Agreement::kPartial;
    ++match.error;
  }
}

// Where sweeps along the axes see main pieces part from their components.
std::vector<Places> Repair::places_of_difference(std::int32_t round) {
  std::vector<Places> places(done_.size());
  const ComponentMatch& match = mesh_.match;
  for (std::uint32_t c = 0; c < done_.size(); ++c) {
    const std::uint32_t main = match.main_piece[c];
    if (done_[c] || main == kNoPiece || match.agreement[c] != Agreement::kNone) continue;
    auto& layers = places[c].layers;
    layers = jumps_between({mesh_.built.mesh, [&](std::uint32_t v) { return match.piece_of[v] == main; }},
                           {polygonized().mesh, [&](std::uint32_t v) { return polygonized().component[v] == c; }},
                           isosurface_.step(), grid_.dims());
    if (places[c].count() > (round == 1 ? kFewPlaces : kMostPlaces)) places[c] = {};
  }
  return places;
}

const PolygonizedSurface& Repair::polygonized() {
  if (!polygonized_) polygonized_ = polygonized_surface(grid_, isosurface_, topology_);
  return *polygonized_;
}

// Keeps a mesh when some component agrees with it that agreed with no earlier one.
void Repair::keep(const MatchedMesh& mesh) {
  bool helps = false;
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (mesh.match.agreement[c] <= best_[c]) continue;
    best_[c] = std::min(mesh.match.agreement[c], Agreement::kWithStrays);
    done_[c] = best_[c] == Agreement::kWithStrays;
    helps = true;
  }
  if (!helps) return;
  history_.push_back(mesh);
  const std::vector<double> heights = compute_poles(*restricted_);
  SurfaceMesh& kept = history_.back().built.mesh;
  for (const VertexId v : mesh.built.vertex_of) kept.pole_heights.push_back(heights[v.index()]);
}

// Every component as the latest mesh that agrees with it has it, so that most come from one triangulation; strays are
// dropped.
SurfaceMesh Repair::assemble_kept() {
  SurfaceMesh kept;
  std::vector<bool> taken(done_.size(), false);
  for (auto mesh = history_.rbegin(); mesh != history_.rend(); ++mesh) {
    const ComponentMatch& match = mesh->match;
    std::vector<bool> wanted(match.pieces.size(), false);
    for (std::size_t c = 0; c < done_.size(); ++c) {
      if (taken[c] || best_[c] == Agreement::kNone || match.agreement[c] < best_[c]) continue;
      taken[c] = wanted[match.main_piece[c]] = true;
      stats_.components_partial += match.agreement[c] == Agreement::kPartial ? 1 : 0;
      stats_.components_mixed += match.agreement[c] == Agreement::kMixed ? 1 : 0;
      stats_.components_stray += match.agreement[c] == Agreement::kWithStrays ? 1 : 0;
    }
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) continue;
    separate_copies(mesh->built.mesh, mesh->built.groups, mesh->built.vertex_of, isosurface_.box());
    append_pieces(mesh->built.mesh, match.piece_of, wanted, kept);
  }
  stats_.components_polygonized = std::count(taken.begin(), taken.end(), false);
  if (stats_.components_polygonized == 0) return kept;
  // Pieces of two meshes may cross where components come near each other; a small surface is then polygonized as a
  // whole.
  if (topology_.crossings.size() <= kSmallSurface) {
    kept = {};
    taken.assign(taken.size(), false);
    stats_.components_polygonized = static_cast<std::int64_t>(taken.size());
  }
  taken.flip();
  append_pieces(polygonized().mesh, polygonized().component, taken, kept);
  return kept;
}

}  // namespace

SurfaceMesh repair(const ScalarGrid& grid, const IsosurfaceTopology& topology,
                   std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls,
                   RepairStats& stats) {
  return Repair(grid, topology, std::move(restricted), stats).run(max_rounds, controls);
}

}  // namespace deliso
