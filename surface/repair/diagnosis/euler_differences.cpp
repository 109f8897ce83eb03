#include "surface/repair/diagnosis/euler_differences.h"

#include <algorithm>

namespace deliso {

namespace {

// The number of components handled in one pass.
constexpr std::size_t kAtOnce = 256;
// Jumps nearer to each other than this form one range: Euler curves err by a few layers.
constexpr std::int32_t kCloseLayers = 4;

std::vector<LayerRange> ranges_of(const std::vector<std::int32_t>& layers) {
  std::vector<LayerRange> ranges;
  for (const std::int32_t layer : layers) {
    if (!ranges.empty() && layer - ranges.back().last < kCloseLayers) {
      ranges.back().last = layer;
    } else {
      ranges.push_back({layer, layer});
    }
  }
  return ranges;
}

}  // namespace

std::vector<IndexBox> boxes_at(const std::array<std::vector<std::int32_t>, 3>& jumps, std::size_t most) {
  const std::vector<LayerRange> xs = ranges_of(jumps[0]), ys = ranges_of(jumps[1]), zs = ranges_of(jumps[2]);
  std::vector<IndexBox> boxes;
  if (xs.size() * ys.size() * zs.size() > most) return boxes;
  for (const LayerRange& z : zs) {
    for (const LayerRange& y : ys) {
      for (const LayerRange& x : xs) boxes.push_back({x, y, z});
    }
  }
  return boxes;
}

const std::vector<std::vector<IndexBox>>& EulerDifferences::find(const std::shared_ptr<MatchedMesh>& mesh,
                                                                 const std::vector<bool>& done, std::size_t most) {
  if (of_.lock() == mesh && most_ == most) return boxes_;
  of_.reset();
  most_ = most;
  boxes_.assign(done.size(), {});
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
  return boxes_;
}

void EulerDifferences::find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components) {
  const ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> part_of_piece(match.pieces.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) part_of_piece[match.main_piece[components[i]]] = i;
  std::vector<std::uint32_t> part_of_vertex(match.piece_of.size(), kNoPart);
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v) {
    if (match.piece_of[v] != kNoPiece) part_of_vertex[v] = part_of_piece[match.piece_of[v]];
  }
  const ExactSurface& surface = cache_.surface();
  const std::vector<EulerCurves> curves = euler_curves(mesh.built.mesh, part_of_vertex, components.size(),
                                                       surface.isosurface.step(), surface.grid().dims());
  for (std::size_t i = 0; i < components.size(); ++i) {
    boxes_[components[i]] = boxes_at(jumps_between(curves[i], cache_.euler_curves().of(components[i])), most_);
  }
}

}  // namespace deliso
