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

// How many layers from the places tetrahedra are tried: disputed ones, and others one by one.
constexpr std::int32_t kReach = 6;
constexpr std::int32_t kReachOfSingles = 3;
// A handle is a matter of few tetrahedra.
constexpr std::size_t kLargestCluster = 100;
// Meshes built for one component at most, for the ones and the others.
constexpr int kMostTrials = 64;
constexpr int kMostTrialsOfSingles = 16;

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

// Whether some neighbour has the sign that the tetrahedra would take: otherwise they would be but a pocket.
bool has_neighbour_of_other_sign(const SignedDelaunay& restricted, std::span<const TetId> tets) {
  return std::any_of(tets.begin(), tets.end(), [&](TetId t) {
    for (unsigned face = 0; face < 4; ++face) {
      if (restricted.is_restricted(FacetId(t, face))) return true;
    }
    return false;
  });
}

bool touches_box(const SignedDelaunay& restricted, std::span<const TetId> tets) {
  return std::any_of(tets.begin(), tets.end(), [&](TetId t) {
    const auto& vertices = restricted.delaunay().vertices(t);
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](VertexId v) { return !restricted.is_virtual(v) && restricted.is_on_box(v); });
  });
}

bool is_nearer(const DisagreementCluster& a, const DisagreementCluster& b) { return a.distance < b.distance; }

// How much is missing or too much in all.
std::int64_t amount(const ComponentTopology& missing) {
  return std::abs(missing.euler_characteristic) + std::abs(missing.boundary_loops);
}

}  // namespace

SignSearch::SignSearch(RepairRound& round, const IsosurfaceTopology& topology, const CellLevels& cells,
                       std::span<const SignRule> rules, const std::vector<IndexRanges>& places)
    : round_(round), topology_(topology), cells_(cells), places_(places) {
  const TetSigns signs = round_.restricted().signs();
  for (const SignRule rule : rules) {
    round_.take_signs(rule);
    signs_by_rule_.push_back(round_.restricted().signs());
  }
  round_.set_signs(signs);
}

// What the component has more than its main piece.
ComponentTopology SignSearch::missing(const MatchedMesh& mesh, std::uint32_t component) const {
  ComponentTopology missing = topology_.components[component];
  const std::uint32_t main = mesh.match.main_piece[component];
  if (main == kNoPiece) return missing;
  missing.euler_characteristic -= mesh.match.pieces[main].topology.euler_characteristic;
  missing.boundary_loops -= mesh.match.pieces[main].topology.boundary_loops;
  return missing;
}

// Those on whose signs some rule disagrees with the signs as they stand; the nearest first.
std::vector<DisagreementCluster> SignSearch::clusters_near(const IndexRanges& places) const {
  const SignedDelaunay& restricted = round_.restricted();
  const DistanceFromRanges distance_from_places(places.likely, cells_.dims(), kReach);
  const auto distance = [&](TetId t) {
    const std::int32_t layers = distance_from_places(cells_.cell_of(centre_of(restricted, t)));
    return layers <= kReach ? layers : -1;
  };
  std::vector<DisagreementCluster> clusters;
  for (const TetSigns& signs : signs_by_rule_) {
    for (DisagreementCluster& cluster : disagreement_clusters(restricted, signs, distance)) {
      clusters.push_back(std::move(cluster));
    }
  }
  std::stable_sort(clusters.begin(), clusters.end(), is_nearer);
  return clusters;
}

// Of all components at once: most of the time goes into asking where tetrahedra are.
void SignSearch::find_undecided() {
  const SignedDelaunay& restricted = round_.restricted();
  const std::span<const std::uint8_t> evidence = round_.evidence();
  std::vector<std::pair<std::uint32_t, DistanceFromRanges>> distances;  // from the places of components
  for (std::uint32_t c = 0; c < places_.size(); ++c) {
    if (places_[c].likely.empty()) continue;
    distances.emplace_back(c, DistanceFromRanges(places_[c].likely, cells_.dims(), kReachOfSingles));
  }
  struct Near {
    TetId tet;
    std::uint32_t component;
    std::int32_t layers;
  };
  const auto append_if_near = [&](std::size_t i, std::vector<Near>& near) {
    const TetId t(i);
    const bool is_decided = evidence[i] == kAbove || evidence[i] == kBelow;
    if (is_decided || !restricted.delaunay().is_live(t) || restricted.delaunay().is_ghost(t)) return;
    const CellIndex cell = cells_.cell_of(centre_of(restricted, t));
    for (const auto& [component, distance] : distances) {
      const std::int32_t layers = distance(cell);
      if (layers <= kReachOfSingles) near.push_back({t, component, layers});
    }
  };
  undecided_.resize(places_.size());
  for (const Near& one : collect_in_blocks<Near>(evidence.size(), round_.threads(), append_if_near)) {
    undecided_[one.component].push_back({one.tet, one.layers});
  }
  for (std::vector<Single>& singles : undecided_) {
    std::stable_sort(singles.begin(), singles.end(),
                     [](const Single& a, const Single& b) { return a.layers < b.layers; });
  }
}

void SignSearch::mend(std::uint32_t component, std::shared_ptr<MatchedMesh> mesh, const Improved& improved,
                      Controls& controls) {
  const std::vector<DisagreementCluster> clusters = clusters_near(places_[component]);
  if (!try_all(clusters, kMostTrials, component, mesh, improved, controls)) return;
  if (undecided_.empty()) find_undecided();
  std::vector<DisagreementCluster> singles;
  for (const Single& single : undecided_[component]) singles.push_back({{single.tet}, single.layers});
  try_all(singles, kMostTrialsOfSingles, component, mesh, improved, controls);
}

// Returns whether there is still something to mend.
bool SignSearch::try_all(const std::vector<DisagreementCluster>& clusters, int most, std::uint32_t component,
                         std::shared_ptr<MatchedMesh>& mesh, const Improved& improved, Controls& controls) {
  TetSigns signs = round_.restricted().signs();
  int trials = 0;
  for (const DisagreementCluster& cluster : clusters) {
    const ComponentTopology lacks = missing(*mesh, component);
    if (lacks.euler_characteristic == 0 || controls.poll()) return false;
    if (trials == most) break;
    if (cluster.tets.size() > kLargestCluster) continue;
    if (!has_neighbour_of_other_sign(round_.restricted(), cluster.tets)) continue;
    const std::int64_t change = round_.euler_change(cluster.tets);
    if (change == 0 || (change > 0) != (lacks.euler_characteristic > 0)) continue;
    // Too much is no better than too little, unless loops of the boundary come right.
    const bool comes_nearer = std::abs(lacks.euler_characteristic - change) < std::abs(lacks.euler_characteristic);
    if (!comes_nearer && !touches_box(round_.restricted(), cluster.tets)) continue;
    ++trials;
    round_.overturn(cluster.tets);
    const auto is_better = [&](const MatchedMesh& trial) {
      return amount(missing(trial, component)) < amount(lacks) && trial.match.error <= mesh->match.error;
    };
    std::optional<MatchedMesh> trial = round_.assemble(is_better);
    if (trial && is_better(*trial)) {
      mesh = std::make_shared<MatchedMesh>(*std::move(trial));
      signs = round_.restricted().signs();
      if (improved(mesh)) return false;
    } else {
      round_.set_signs(signs);
    }
  }
  return missing(*mesh, component).euler_characteristic != 0;
}

}  // namespace deliso
