#include "surface/repair/rounds/sign_search.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/signs/sign_constraints.h"

namespace deliso {

namespace {

// Tetrahedra within this many layers of the boxes are tried.
constexpr std::int32_t kReach = 3;
// How many tetrahedra of a component are tried, at most, and how many of them with one mesh.
constexpr int kMostTrials = 16;
constexpr std::size_t kMostTogether = 4;
// A component that lacks more than this (Euler characteristic) is left to the next round: trials would not mend it.
constexpr int kMostLacking = 2 * kMostTrials;
// Cells along the side of a block of cells.
constexpr std::int32_t kBlock = 16;

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

// The blocks of cells near which some boxes lie, each with the boxes' owners, ascending.
using Block = std::array<std::int32_t, 3>;
using OwnersNearBlocks = std::map<Block, std::vector<std::uint32_t>>;

void add_boxes(const std::vector<IndexBox>& boxes, std::uint32_t owner, const CellLevels& cells,
               OwnersNearBlocks& owners) {
  for (const IndexBox& box : boxes) {
    Block low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(box[axis].first - kReach, 0) / kBlock;
      high[axis] = std::min(box[axis].last + kReach, cells.dims()[axis] - 1) / kBlock;
    }
    for (std::int32_t k = low[2]; k <= high[2]; ++k) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        for (std::int32_t i = low[0]; i <= high[0]; ++i) {
          std::vector<std::uint32_t>& here = owners[{i, j, k}];
          if (here.empty() || here.back() != owner) here.push_back(owner);
        }
      }
    }
  }
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

// What each component adds to ComponentMatch::error.
std::vector<std::int64_t> SignSearch::errors(const MatchedMesh& mesh) const {
  std::vector<std::int64_t> errors(topology_.components.size(), -1);
  for (const MeshPiece& piece : mesh.match.pieces) {
    if (piece.component != kNoComponent) ++errors[piece.component];
  }
  for (std::uint32_t c = 0; c < errors.size(); ++c) {
    const bool is_exact = mesh.match.agreement[c] == Agreement::kExact;
    errors[c] =
        is_exact ? 0 : 1 + std::max<std::int64_t>(errors[c], 0) + std::abs(missing(mesh, c).euler_characteristic);
  }
  return errors;
}

// The components that lack little and are not done, each with its undecided tetrahedra. Those of all components are
// found in one pass, because most of the time is spent on the distances of tetrahedra.
std::vector<SignSearch::Queue> SignSearch::queues(const MatchedMesh& mesh, const std::vector<bool>& done) const {
  std::vector<Queue> queues;
  std::vector<DistanceFromRanges> distances;  // from the boxes of each queue's component
  OwnersNearBlocks owners;
  for (std::uint32_t c = 0; c < boxes_.size(); ++c) {
    const std::vector<IndexBox>& likely = boxes_[c].likely;
    const std::int64_t lacks = std::abs(missing(mesh, c).euler_characteristic);
    if (done[c] || likely.empty() || lacks == 0 || lacks > kMostLacking) continue;
    add_boxes(likely, static_cast<std::uint32_t>(queues.size()), cells_, owners);
    queues.push_back({c, {}});
    distances.emplace_back(likely, cells_.dims(), kReach);
  }
  if (queues.empty()) return queues;
  struct Near {
    TetId tet;
    std::uint32_t queue;
    std::int32_t layers;
  };
  const SignedDelaunay& restricted = round_.restricted();
  const std::span<const std::uint8_t> constraints = round_.sign_constraints();
  const auto append_if_near = [&](std::size_t i, std::vector<Near>& near) {
    const TetId t(i);
    const bool is_decided = constraints[i] == kAbove || constraints[i] == kBelow;
    if (is_decided || !restricted.delaunay().is_live(t) || restricted.delaunay().is_ghost(t)) return;
    const CellIndex cell = cells_.cell_of(centre_of(restricted, t));
    const auto here = owners.find({cell[0] / kBlock, cell[1] / kBlock, cell[2] / kBlock});
    if (here == owners.end()) return;
    for (const std::uint32_t queue : here->second) {
      const std::int32_t layers = distances[queue](cell);
      if (layers <= kReach) near.push_back({t, queue, layers});
    }
  };
  std::vector<Near> near = collect_in_blocks<Near>(constraints.size(), round_.threads(), append_if_near);
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.layers < b.layers; });
  for (const Near& one : near) queues[one.queue].tets.push_back(one.tet);
  return queues;
}

void SignSearch::mend(std::shared_ptr<MatchedMesh> mesh, const std::vector<bool>& done, const Improved& improved,
                      Controls& controls) {
  std::vector<Queue> queues = this->queues(*mesh, done);
  while (!controls.poll()) {
    const TetSigns signs = round_.restricted().signs();
    const std::vector<Flip> tried = next_flips(*mesh, done, queues);
    if (tried.empty()) return;
    std::vector<Flip> flips = tried;
    // Those that help are tried once more without the others.
    while (!flips.empty()) {
      const std::shared_ptr<MatchedMesh> trial = flipped(flips, *mesh);
      std::vector<Flip> helpful = trial ? helpful_of(flips, *mesh, *trial) : std::vector<Flip>();
      const bool all_help = helpful.size() == flips.size();
      if (all_help && trial->match.error <= mesh->match.error) {
        mesh = trial;
        improved(mesh);
        break;
      }
      round_.set_signs(signs);
      if (all_help) helpful.clear();
      flips = std::move(helpful);
    }
    put_back(tried, flips, queues);
  }
}

// The next tetrahedra of each queue that are worth trying.
std::vector<SignSearch::Flip> SignSearch::next_flips(const MatchedMesh& mesh, const std::vector<bool>& done,
                                                     std::vector<Queue>& queues) {
  std::vector<Flip> flips;
  for (std::size_t i = 0; i < queues.size(); ++i) {
    if (!done[queues[i].component]) append_flips(mesh, i, queues[i], flips);
  }
  return flips;
}

// Tetrahedra of a queue that do not touch each other, so that their changes add up, to at most what is missing.
void SignSearch::append_flips(const MatchedMesh& mesh, std::size_t number, Queue& queue, std::vector<Flip>& flips) {
  std::int64_t lacks = missing(mesh, queue.component).euler_characteristic;
  std::set<VertexId> touched;
  const std::size_t first = flips.size();
  queue.tried_from = queue.next;
  while (queue.next < queue.tets.size() && lacks != 0 && queue.trials < kMostTrials) {
    const TetId t = queue.tets[queue.next];
    const std::int64_t change = useful_change(t, lacks);
    const auto& vertices = round_.restricted().delaunay().vertices(t);
    if (change != 0) {
      if (std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return touched.contains(v); })) return;
      touched.insert(vertices.begin(), vertices.end());
      flips.push_back({number, queue.component, t, change});
      lacks -= change;
      ++queue.trials;
    }
    ++queue.next;
    if (flips.size() - first == (queue.one_by_one ? 1 : kMostTogether)) return;
  }
}

// Has those tried one by one that did not help together.
void SignSearch::put_back(const std::vector<Flip>& tried, const std::vector<Flip>& kept, std::vector<Queue>& queues) {
  std::vector<int> refused(queues.size(), 0);
  for (const Flip& flip : tried) ++refused[flip.queue];
  for (const Flip& flip : kept) refused[flip.queue] = 0;
  for (std::size_t i = 0; i < queues.size(); ++i) {
    if (refused[i] < 2) continue;
    queues[i].next = queues[i].tried_from;
    queues[i].trials -= refused[i];
    queues[i].one_by_one = true;
  }
}

// The mesh with some signs flipped. Nothing if none of these flips helps.
std::shared_ptr<MatchedMesh> SignSearch::flipped(const std::vector<Flip>& flips, const MatchedMesh& before) {
  std::vector<TetId> tets;
  tets.reserve(flips.size());
  for (const Flip& flip : flips) tets.push_back(flip.tet);
  round_.flip_signs(tets);
  std::optional<MatchedMesh> trial =
      round_.assemble([&](const MatchedMesh& mesh) { return !helpful_of(flips, before, mesh).empty(); });
  return trial ? std::make_shared<MatchedMesh>(*std::move(trial)) : nullptr;
}

// The flips whose component comes nearer to its topology, several by half of what they should bring at least, while
// that and the components at its flips are together no worse.
std::vector<SignSearch::Flip> SignSearch::helpful_of(const std::vector<Flip>& flips, const MatchedMesh& before,
                                                     const MatchedMesh& trial) const {
  const SignedDelaunay& restricted = round_.restricted();
  const std::vector<std::int64_t> errors_before = errors(before), errors_now = errors(trial);
  std::vector<Flip> helpful;
  for (auto first = flips.begin(); first != flips.end();) {
    const std::uint32_t component = first->component;
    const auto last = std::find_if(first, flips.end(), [&](const Flip& flip) { return flip.component != component; });
    std::set<std::uint32_t> met = {component};
    std::int64_t hoped = 0;
    for (auto flip = first; flip != last; ++flip) {
      hoped += std::abs(flip->change);
      for (const VertexId v : restricted.delaunay().vertices(flip->tet)) {
        if (!restricted.is_virtual(v)) met.insert(round_.component_of_vertex()[v.index()]);
      }
    }
    met.erase(kNoComponent);
    std::int64_t change = 0;
    for (const std::uint32_t c : met) change += errors_now[c] - errors_before[c];
    const std::int64_t gained = amount(missing(before, component)) - amount(missing(trial, component));
    if (change <= 0 && gained > 0 && (last - first == 1 || 2 * gained >= hoped)) {
      helpful.insert(helpful.end(), first, last);
    }
    first = last;
  }
  return helpful;
}

// The change of the Euler characteristic by a flip, if it is in the right direction and no more than what is missing; 0
// otherwise. A larger change is allowed where the tetrahedron touches the box, because it may correct the boundary
// loops.
std::int64_t SignSearch::useful_change(TetId t, std::int64_t lacks) {
  if (!has_neighbour_of_other_sign(round_.restricted(), t)) return 0;
  const std::int64_t change = round_.euler_change(t);
  if (change == 0 || (change > 0) != (lacks > 0)) return 0;
  const bool comes_nearer = std::abs(lacks - change) < std::abs(lacks);
  return comes_nearer || touches_box(round_.restricted(), t) ? change : 0;
}

}  // namespace deliso
