#include "surface/repair/diagnosis/euler_differences.h"

#include <algorithm>
#include <utility>

namespace deliso {

namespace {

// The number of components handled in one pass.
constexpr std::size_t kAtOnce = 256;
// Angle defects are not compared where Euler curves give at most so many boxes, none with more layers than this.
constexpr std::size_t kFewFound = 8;
constexpr std::int32_t kWidest = 16;
// Angle defects are compared if there are at most so many components; at most so many boxes of each are taken.
constexpr std::size_t kFewComponents = 8;
constexpr std::size_t kMostByAngleDefects = 16;

bool are_clear(const std::vector<IndexBox>& boxes) {
  const auto is_narrow = [](const IndexBox& box) {
    return std::all_of(box.begin(), box.end(), [](const auto& range) { return range.last - range.first < kWidest; });
  };
  return !boxes.empty() && boxes.size() <= kFewFound && std::all_of(boxes.begin(), boxes.end(), is_narrow);
}

}  // namespace

const std::vector<IndexRanges>& EulerDifferences::find(const std::shared_ptr<MatchedMesh>& mesh,
                                                       const std::vector<bool>& done, const Effort& effort) {
  if (of_.lock() == mesh && effort_ == effort) return boxes_;
  of_.reset();
  effort_ = effort;
  boxes_.assign(done.size(), {});
  std::vector<std::uint32_t> components;
  for (std::uint32_t c = 0; c < done.size(); ++c) {
    const Agreement agreement = mesh->match.agreement[c];
    const bool differs = agreement == Agreement::kNone || agreement == Agreement::kDisplaced;
    if (!done[c] && mesh->match.main_piece[c] != kNoPiece && differs) components.push_back(c);
  }
  for (std::size_t first = 0; first < components.size(); first += kAtOnce) {
    find_for(*mesh, std::span(components).subspan(first, std::min(kAtOnce, components.size() - first)));
  }
  // The jumps of curves that part and meet again are many layers off in noise.
  const auto is_displaced = [&](std::uint32_t c) { return mesh->match.agreement[c] == Agreement::kDisplaced; };
  std::erase_if(components, [&](std::uint32_t c) {
    return !is_displaced(c) && (!effort.takes_angle_defects || are_clear(boxes_[c].all));
  });
  if (components.size() > kFewComponents) {
    std::erase_if(components, [&](std::uint32_t c) { return !is_displaced(c); });
  }
  if (components.size() <= kFewComponents) {
    for (const std::uint32_t c : components) add_by_angle_defects(*mesh, c);
  }
  of_ = mesh;
  return boxes_;
}

// Boxes that have too much are of no use where something is missing in all, nor the other way. Where neither is, both
// are.
void EulerDifferences::add_by_angle_defects(const MatchedMesh& mesh, std::uint32_t component) {
  const ComponentMatch& match = mesh.match;
  const ExactSurface& surface = cache_.surface();
  const std::uint32_t main = match.main_piece[component];
  const std::int64_t too_much =
      match.pieces[main].topology.euler_characteristic - surface.topology.components[component].euler_characteristic;
  AngleDefectGrid difference(surface.grid().dims(), surface.isosurface.step());
  difference.add(mesh.built.mesh, [&](std::uint32_t v) { return match.piece_of[v] == main; });
  difference.subtract(exact_angle_defects(component));
  std::vector<IndexBox> found;
  for (const bool is_positive : {true, false}) {
    if (is_positive ? too_much < 0 : too_much > 0) continue;
    const std::vector<IndexBox> some = difference.places(is_positive, kMostByAngleDefects);
    found.insert(found.end(), some.begin(), some.end());
  }
  if (found.empty()) return;
  IndexRanges& boxes = boxes_[component];
  boxes.likely = found;
  boxes.all.insert(boxes.all.end(), found.begin(), found.end());
}

// Those of the last few components that were asked for are kept: the same ones stay wrong from round to round.
const AngleDefectGrid& EulerDifferences::exact_angle_defects(std::uint32_t component) {
  const auto known = std::find_if(exact_angle_defects_.begin(), exact_angle_defects_.end(),
                                  [&](const auto& one) { return one.first == component; });
  if (known != exact_angle_defects_.end()) return known->second;
  if (exact_angle_defects_.size() == kFewComponents) exact_angle_defects_.erase(exact_angle_defects_.begin());
  const ExactSurface& surface = cache_.surface();
  const auto& [exact, component_of] = cache_.polygonized();
  AngleDefectGrid& defects =
      exact_angle_defects_.emplace_back(component, AngleDefectGrid(surface.grid().dims(), surface.isosurface.step()))
          .second;
  defects.add(exact, [component, &of = component_of](std::uint32_t v) { return of[v] == component; });
  return defects;
}

EulerDifferences::Parts EulerDifferences::compare(const MatchedMesh& mesh,
                                                  std::span<const std::uint32_t> components) const {
  const ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> part_of_piece(match.pieces.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) part_of_piece[match.main_piece[components[i]]] = i;
  Parts parts{std::vector<std::uint32_t>(match.piece_of.size(), kNoPart), {}};
  for (std::size_t v = 0; v < match.piece_of.size(); ++v) {
    if (match.piece_of[v] != kNoPiece) parts.part_of_vertex[v] = part_of_piece[match.piece_of[v]];
  }
  const ExactSurface& surface = cache_.surface();
  const std::vector<EulerCurves> curves = euler_curves(mesh.built.mesh, parts.part_of_vertex, components.size(),
                                                       surface.isosurface.step(), surface.grid().dims());
  parts.jumps.reserve(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    parts.jumps.push_back(jumps_between(curves[i], cache_.euler_curves().of(components[i])));
  }
  return parts;
}

// A piece without handles cannot have one elsewhere.
void EulerDifferences::find_displaced(MatchedMesh& mesh, const std::vector<bool>& done, std::size_t most_boxes) const {
  ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> components;
  for (std::uint32_t c = 0; c < done.size(); ++c) {
    if (done[c] || match.agreement[c] < Agreement::kDisplaced) continue;
    const ComponentTopology& topology = match.pieces[match.main_piece[c]].topology;
    if (topology.euler_characteristic + topology.boundary_loops < 2) components.push_back(c);
  }
  for (std::size_t first = 0; first < components.size(); first += kAtOnce) {
    const auto some = std::span(components).subspan(first, std::min(kAtOnce, components.size() - first));
    const Parts parts = compare(mesh, some);
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!EulerBoxes::around(parts.jumps[i], cache_.surface().grid().dims(), most_boxes)) continue;
      match.agreement[some[i]] = Agreement::kDisplaced;
      ++match.error;
    }
  }
}

void EulerDifferences::find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components) {
  const auto [part_of_vertex, jumps] = compare(mesh, components);
  const ExactSurface& surface = cache_.surface();
  std::vector<std::optional<EulerBoxes>> several(components.size());
  std::vector<std::uint32_t> part_of_component(boxes_.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    const std::uint32_t c = components[i];
    std::optional<EulerBoxes> boxes = EulerBoxes::around(jumps[i], surface.grid().dims(), effort_.most_boxes);
    if (!boxes) continue;
    boxes_[c] = boxes->boxes();
    if (boxes->count() == 1) continue;
    several[i] = std::move(boxes);
    part_of_component[c] = i;
  }
  sum_changes(mesh, part_of_vertex, part_of_component, several);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (several[i]) boxes_[components[i]] = several[i]->boxes();
  }
}

void EulerDifferences::sum_changes(const MatchedMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                   const std::vector<std::uint32_t>& part_of_component,
                                   std::vector<std::optional<EulerBoxes>>& boxes) const {
  if (std::none_of(boxes.begin(), boxes.end(), [](const auto& some) { return some.has_value(); })) return;
  const ExactSurface& surface = cache_.surface();
  for_each_mesh_change(mesh.built.mesh, part_of_vertex, surface.isosurface.step(), surface.grid().dims(),
                       [&](std::uint32_t part, const SampleLayers& layers, std::int32_t change) {
                         if (boxes[part]) boxes[part]->add(layers, 2 * change);
                       });
  std::vector<bool> layers(static_cast<std::size_t>(surface.grid().dims()[2]), false);
  for (const std::optional<EulerBoxes>& some : boxes) {
    for (std::size_t k = 0; some && k < layers.size(); ++k) layers[k] = layers[k] || some->reach(k);
  }
  for_each_exact_change(surface, layers, [&](std::uint32_t component, const SampleLayers& at, std::int32_t twice) {
    const std::uint32_t part = part_of_component[component];
    if (part != kNoPart) boxes[part]->add(at, -twice);
  });
}

}  // namespace deliso
