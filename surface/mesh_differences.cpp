#include "surface/mesh_differences.h"

#include <algorithm>
#include <iterator>

namespace deliso {

namespace {

// So many components are swept in one go, and as many are remembered at most.
constexpr std::size_t kAtOnce = 256;

}  // namespace

const std::vector<Places>& MeshDifferences::find(const std::shared_ptr<MatchedMesh>& mesh,
                                                 const std::vector<bool>& done, std::size_t most) {
  if (of_.lock() == mesh && most_ == most) return places_;
  of_.reset();
  most_ = most;
  places_.assign(done.size(), {});
  std::vector<std::uint32_t> components;
  for (std::uint32_t c = 0; c < done.size(); ++c) {
    if (!done[c] && mesh->match.main_piece[c] != kNoPiece && mesh->match.agreement[c] == Agreement::kNone) {
      components.push_back(c);
    }
  }
  for (std::size_t first = 0; first < components.size(); first += kAtOnce) {
    find_for(*mesh, std::span(components).subspan(first, std::min(kAtOnce, components.size() - first)));
  }
  of_ = mesh;
  return places_;
}

void MeshDifferences::find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components) {
  const ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> part_of_piece(match.pieces.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) part_of_piece[match.main_piece[components[i]]] = i;
  std::vector<std::uint32_t> part_of_vertex(match.piece_of.size(), kNoPart);
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v) {
    if (match.piece_of[v] != kNoPiece) part_of_vertex[v] = part_of_piece[match.piece_of[v]];
  }
  const std::vector<SweptCharacteristics> swept = swept_characteristics(
      mesh.built.mesh, part_of_vertex, components.size(), isosurface_.step(), facts_.grid().dims());
  sweep_surface(components);
  for (std::size_t i = 0; i < components.size(); ++i) {
    Places& places = places_[components[i]];
    places.layers = jumps_between(swept[i], swept_.at(components[i]));
    if (places.count() > most_) places = {};
  }
}

// Those of the components that are not known.
void MeshDifferences::sweep_surface(std::span<const std::uint32_t> components) {
  if (swept_.size() + components.size() > 2 * kAtOnce) swept_.clear();
  std::vector<std::uint32_t> unknown;
  std::copy_if(components.begin(), components.end(), std::back_inserter(unknown),
               [&](std::uint32_t c) { return !swept_.contains(c); });
  if (unknown.empty()) return;
  const PolygonizedSurface& exact = facts_.polygonized();
  std::vector<std::uint32_t> part_of_component(facts_.topology().components.size(), kNoPart);
  for (std::uint32_t i = 0; i < unknown.size(); ++i) part_of_component[unknown[i]] = i;
  std::vector<std::uint32_t> part_of_vertex(exact.component.size(), kNoPart);
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v)
    if (exact.component[v] < part_of_component.size()) part_of_vertex[v] = part_of_component[exact.component[v]];
  std::vector<SweptCharacteristics> swept =
      swept_characteristics(exact.mesh, part_of_vertex, unknown.size(), isosurface_.step(), facts_.grid().dims());
  for (std::size_t i = 0; i < unknown.size(); ++i) swept_[unknown[i]] = std::move(swept[i]);
}

}  // namespace deliso
