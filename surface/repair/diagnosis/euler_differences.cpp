#include "surface/repair/diagnosis/euler_differences.h"

#include <algorithm>
#include <utility>

#include "surface/repair/diagnosis/angle_defect_grid.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

namespace {

// So many components are swept in one go.
constexpr std::size_t kAtOnce = 256;
// Where sweeps tell of no more places than this, none of more layers than this, they are believed.
constexpr std::size_t kFewSwept = 8;
constexpr std::int32_t kWidest = 16;
// Curvature is looked at for no more components than this, and so many places of each are taken.
constexpr std::size_t kFewComponents = 8;
constexpr std::size_t kMostByCurvature = 16;

bool tell(const std::vector<IndexBox>& swept) {
  const auto is_narrow = [](const IndexBox& place) {
    return std::all_of(place.begin(), place.end(),
                       [](const auto& range) { return range.last - range.first < kWidest; });
  };
  return !swept.empty() && swept.size() <= kFewSwept && std::all_of(swept.begin(), swept.end(), is_narrow);
}

}  // namespace

const std::vector<IndexRanges>& EulerDifferences::find(const std::shared_ptr<MatchedMesh>& mesh,
                                                       const std::vector<bool>& done, const Effort& effort) {
  if (of_.lock() == mesh && effort_ == effort) return places_;
  of_.reset();
  effort_ = effort;
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
  std::erase_if(components, [&](std::uint32_t c) { return tell(places_[c].all); });
  if (effort.takes_curvature && components.size() <= kFewComponents) {
    for (const std::uint32_t c : components) add_by_curvature(*mesh, c);
  }
  of_ = mesh;
  return places_;
}

// Places that have too much are of no use where something is missing in all, nor the other way.
void EulerDifferences::add_by_curvature(const MatchedMesh& mesh, std::uint32_t component) {
  const ComponentMatch& match = mesh.match;
  const std::uint32_t main = match.main_piece[component];
  const std::int64_t too_much = match.pieces[main].topology.euler_characteristic -
                                facts_.surface().topology.components[component].euler_characteristic;
  if (too_much == 0) return;
  const auto& [exact, component_of] = facts_.polygonized();
  AngleDefectGrid difference(facts_.surface().grid().dims(), facts_.surface().isosurface.step());
  difference.add(
      mesh.built.mesh, [&](std::uint32_t v) { return match.piece_of[v] == main; }, 1);
  difference.add(
      exact, [component, &of = component_of](std::uint32_t v) { return of[v] == component; }, -1);
  const std::vector<IndexBox> found = difference.places(too_much > 0, kMostByCurvature);
  if (found.empty()) return;
  IndexRanges& places = places_[component];
  places.likely = found;
  places.all.insert(places.all.end(), found.begin(), found.end());
}

void EulerDifferences::find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components) {
  const ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> part_of_piece(match.pieces.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) part_of_piece[match.main_piece[components[i]]] = i;
  std::vector<std::uint32_t> part_of_vertex(match.piece_of.size(), kNoPart);
  for (std::size_t v = 0; v < part_of_vertex.size(); ++v) {
    if (match.piece_of[v] != kNoPiece) part_of_vertex[v] = part_of_piece[match.piece_of[v]];
  }
  const std::vector<EulerCurves> swept =
      euler_curves(mesh.built.mesh, part_of_vertex, components.size(), facts_.surface().isosurface.step(),
                   facts_.surface().grid().dims());
  const Dims& dims = facts_.surface().grid().dims();
  std::vector<std::optional<EulerBoxes>> boxes(components.size());
  std::vector<std::uint32_t> part_of_component(places_.size(), kNoPart);
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    auto around = EulerBoxes::around(jumps_between(swept[i], facts_.sweeps().of(components[i])), dims);
    if (!around || around->count() > effort_.most_places) continue;
    if (around->count() == 1) {
      places_[components[i]] = around->places();
      continue;
    }
    boxes[i] = std::move(around);
    part_of_component[components[i]] = i;
  }
  count_in_boxes(mesh, part_of_vertex, part_of_component, boxes);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (boxes[i]) places_[components[i]] = boxes[i]->places();
  }
}

// Which places differ indeed is to be found out where there are several.
void EulerDifferences::count_in_boxes(const MatchedMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                      const std::vector<std::uint32_t>& part_of_component,
                                      std::vector<std::optional<EulerBoxes>>& boxes) const {
  if (std::none_of(boxes.begin(), boxes.end(), [](const auto& box) { return box.has_value(); })) return;
  const Dims& dims = facts_.surface().grid().dims();
  // The cells whose corners' layers may count in some of the boxes, and few others.
  const auto is_reached = [&](std::size_t axis, std::int32_t layer) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) { return box && box->reach(axis, layer); });
  };
  const CellLayers reached(dims, [&](std::size_t axis, std::int32_t layer) {
    return is_reached(axis, layer) || is_reached(axis, layer + 1);
  });
  for_each_mesh_change(mesh.built.mesh, part_of_vertex, facts_.surface().isosurface.step(), dims,
                       [&](std::uint32_t part, const SampleLayers& layers, std::int32_t change) {
                         if (boxes[part]) boxes[part]->add(layers, 2 * change);
                       });
  for_each_exact_change(facts_.surface(), reached,
                        [&](std::uint32_t component, const SampleLayers& layers, std::int32_t twice) {
                          const std::uint32_t part = part_of_component[component];
                          if (part != kNoPart) boxes[part]->add(layers, -twice);
                        });
}

}  // namespace deliso
