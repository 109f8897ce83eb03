#include "surface/repair/rounds/sign_search.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/signs/sign_constraints.h"

namespace deliso {

namespace {

// Tetrahedra within this many layers of the boxes are tried.
constexpr std::int32_t kReach = 3;
// The largest number of meshes built for one component.
constexpr int kMostTrials = 16;

Vec3 centre_of(const SignedDelaunay& restricted, TetId t) {
  Vec3 sum;
  double count = 0;
  for (const VertexId v : restricted.delaunay().vertices(t)) {
    if (restricted.is_virtual(v)) continue;
    sum += restricted.delaunay().point(v);
    count += 1;
  }
  return sum / count;
}

// Whether some neighbour has the sign that the tetrahedron would get. Without such a neighbour it would become a pocket
// of its own.
bool has_neighbour_of_other_sign(const SignedDelaunay& restricted, TetId t) {
  const auto is_restricted = [&](unsigned face) { return restricted.is_restricted(FacetId(t, face)); };
  return is_restricted(0) || is_restricted(1) || is_restricted(2) || is_restricted(3);
}

bool touches_box(const SignedDelaunay& restricted, TetId t) {
  const auto& vertices = restricted.delaunay().vertices(t);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](VertexId v) { return !restricted.is_virtual(v) && restricted.is_on_box(v); });
}

// The size of the difference.
std::int64_t amount(const ComponentTopology& missing) {
  return std::abs(missing.euler_characteristic) + std::abs(missing.boundary_loops);
}

}  // namespace

// The topology of the component minus that of its main piece.
ComponentTopology SignSearch::missing(const MatchedMesh& mesh, std::uint32_t component) const {
  ComponentTopology missing = topology_.components[component];
  const std::uint32_t main = mesh.match.main_piece[component];
  if (main == kNoPiece) return missing;
  missing.euler_characteristic -= mesh.match.pieces[main].topology.euler_characteristic;
  missing.boundary_loops -= mesh.match.pieces[main].topology.boundary_loops;
  return missing;
}

// Finds them for all components in one pass, because most of the time is spent on the distances of tetrahedra.
void SignSearch::find_undecided() {
  const SignedDelaunay& restricted = round_.restricted();
  const std::span<const std::uint8_t> constraints = round_.sign_constraints();
  std::vector<std::pair<std::uint32_t, DistanceFromRanges>> distances;  // from the boxes of each component
  for (std::uint32_t c = 0; c < boxes_.size(); ++c) {
    const std::vector<IndexBox>& likely = boxes_[c].likely;
    if (!likely.empty()) distances.emplace_back(c, DistanceFromRanges(likely, cells_.dims(), kReach));
  }
  struct Near {
    TetId tet;
    std::uint32_t component;
    std::int32_t layers;
  };
  const auto append_if_near = [&](std::size_t i, std::vector<Near>& near) {
    const TetId t(i);
    const bool is_decided = constraints[i] == kAbove || constraints[i] == kBelow;
    if (is_decided || !restricted.delaunay().is_live(t) || restricted.delaunay().is_ghost(t)) return;
    const CellIndex cell = cells_.cell_of(centre_of(restricted, t));
    for (const auto& [component, distance] : distances) {
      const std::int32_t layers = distance(cell);
      if (layers <= kReach) near.push_back({t, component, layers});
    }
  };
  std::vector<Near> near = collect_in_blocks<Near>(constraints.size(), round_.threads(), append_if_near);
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.layers < b.layers; });
  undecided_.resize(boxes_.size());
  for (const Near& one : near) undecided_[one.component].push_back(one.tet);
}

void SignSearch::mend(std::uint32_t component, std::shared_ptr<MatchedMesh> mesh, const Improved& improved,
                      Controls& controls) {
  if (undecided_.empty()) find_undecided();
  TetSigns signs = round_.restricted().signs();
  int trials = 0;
  for (const TetId t : undecided_[component]) {
    const ComponentTopology lacks = missing(*mesh, component);
    if (lacks.euler_characteristic == 0 || trials == kMostTrials || controls.poll()) return;
    if (!is_worth_trying(t, lacks)) continue;
    ++trials;
    round_.flip_sign(t);
    const auto is_better = [&](const MatchedMesh& trial) {
      return amount(missing(trial, component)) < amount(lacks) && trial.match.error <= mesh->match.error;
    };
    std::optional<MatchedMesh> trial = round_.assemble(is_better);
    if (trial && is_better(*trial)) {
      mesh = std::make_shared<MatchedMesh>(*std::move(trial));
      signs = round_.restricted().signs();
      if (improved(mesh)) return;
    } else {
      round_.set_signs(signs);
    }
  }
}

// Whether a flip changes the Euler characteristic in the right direction, by no more than what is missing. A larger
// change is allowed where the tetrahedron touches the box, because it may correct the boundary loops.
bool SignSearch::is_worth_trying(TetId t, const ComponentTopology& lacks) {
  if (!has_neighbour_of_other_sign(round_.restricted(), t)) return false;
  const std::int64_t change = round_.euler_change(t);
  if (change == 0 || (change > 0) != (lacks.euler_characteristic > 0)) return false;
  const bool comes_nearer = std::abs(lacks.euler_characteristic - change) < std::abs(lacks.euler_characteristic);
  return comes_nearer || touches_box(round_.restricted(), t);
}

}  // namespace deliso
