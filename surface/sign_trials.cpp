#include "surface/sign_trials.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

namespace deliso {

namespace {

// How many layers from the places tetrahedra are tried.
constexpr std::int32_t kReach = 6;
// Meshes built for one component at most.
constexpr int kMostTrials = 64;

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

// How much is missing or too much in all.
std::int64_t amount(const ComponentTopology& missing) {
  return std::abs(missing.euler_characteristic) + std::abs(missing.boundary_loops);
}

}  // namespace

SignTrials::SignTrials(RepairRound& round, const IsosurfaceTopology& topology, const RaisedCells& cells,
                       std::span<const SignRule> rules)
    : round_(round), topology_(topology), cells_(cells) {
  const std::vector<bool> signs = round_.restricted().signs();
  for (const SignRule rule : rules) {
    round_.take_signs(rule);
    signs_by_rule_.push_back(round_.restricted().signs());
  }
  round_.set_signs(signs);
}

// What the component has more than its main piece.
ComponentTopology SignTrials::missing(const MatchedMesh& mesh, std::uint32_t component) const {
  ComponentTopology missing = topology_.components[component];
  const std::uint32_t main = mesh.match.main_piece[component];
  if (main == kNoPiece) return missing;
  missing.euler_characteristic -= mesh.match.pieces[main].topology.euler_characteristic;
  missing.boundary_loops -= mesh.match.pieces[main].topology.boundary_loops;
  return missing;
}

// Those on whose signs some rule disagrees with the signs as they stand; the nearest first.
std::vector<DisputedCluster> SignTrials::clusters_near(const Places& places) const {
  const SignedDelaunay& restricted = round_.restricted();
  const auto distance = [&](TetId t) {
    const std::int32_t layers = places.distance(cells_.cell_of(centre_of(restricted, t)));
    return layers <= kReach ? layers : -1;
  };
  std::vector<DisputedCluster> clusters;
  for (const std::vector<bool>& signs : signs_by_rule_) {
    for (DisputedCluster& cluster : disputed_clusters(restricted, signs, distance)) {
      clusters.push_back(std::move(cluster));
    }
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const DisputedCluster& a, const DisputedCluster& b) { return a.distance < b.distance; });
  return clusters;
}

void SignTrials::mend(std::uint32_t component, const Places& places, std::shared_ptr<MatchedMesh> mesh,
                      const std::function<bool(std::shared_ptr<MatchedMesh>)>& improved, Controls& controls) {
  std::vector<bool> signs = round_.restricted().signs();
  int trials = 0;
  for (const DisputedCluster& cluster : clusters_near(places)) {
    const ComponentTopology lacks = missing(*mesh, component);
    if (lacks.euler_characteristic == 0 || trials == kMostTrials || controls.poll()) return;
    const std::int64_t change = round_.change_of_characteristic(cluster.tets);
    if (change == 0 || (change > 0) != (lacks.euler_characteristic > 0)) continue;
    ++trials;
    round_.overturn(cluster.tets);
    std::optional<MatchedMesh> trial = round_.assemble();
    if (trial && amount(missing(*trial, component)) < amount(lacks) && trial->match.error <= mesh->match.error) {
      mesh = std::make_shared<MatchedMesh>(*std::move(trial));
      signs = round_.restricted().signs();
      if (improved(mesh)) return;
    } else {
      round_.set_signs(signs);
    }
  }
}

}  // namespace deliso
