#include "surface/mesh_differences.h"

#include <algorithm>

namespace deliso {

namespace {

// So many components are swept in one go.
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
  for (std::size_t i = 0; i < components.size(); ++i) {
    Places& places = places_[components[i]];
    places.layers = jumps_between(swept[i], facts_.sweeps().of(components[i]));
    if (places.count() > most_) places = {};
  }
}

}  // namespace deliso
