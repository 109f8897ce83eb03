#include "experiments/lesson/trace/repair_events.h"

#include <set>
#include <utility>

#include "surface/certificate/component_match.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/certificate/promise.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

const char* agreement_name(Agreement agreement) {
  switch (agreement) {
    case Agreement::kNone:
      return "different";
    case Agreement::kPartial:
      return "partial";
    case Agreement::kDisplaced:
      return "displaced";
    case Agreement::kMixed:
      return "mixed";
    case Agreement::kWithStrays:
      return "with_strays";
    case Agreement::kExact:
      break;
  }
  return "exact";
}

TraceEvent topology_of(const ComponentTopology& topology) {
  return {{"chi", topology.euler_characteristic}, {"loops", topology.boundary_loops}};
}

// A number that may be none.
TraceEvent number_or_none(std::uint32_t number, std::uint32_t none) {
  return number == none ? TraceEvent(-1) : TraceEvent(number);
}

TraceEvent components_of(const ObservedComparison& comparison) {
  const ComponentMatch& match = comparison.mesh.match;
  TraceEvent all = TraceEvent::array();
  for (std::size_t c = 0; c < comparison.topology.components.size(); ++c) {
    TraceEvent component = topology_of(comparison.topology.components[c]);
    component["piece"] = number_or_none(match.main_piece[c], kNoPiece);
    component["is"] = agreement_name(match.agreement[c]);
    component["done"] = static_cast<bool>(comparison.done[c]);
    all.push_back(std::move(component));
  }
  return all;
}

TraceEvent pieces_of(const MatchedMesh& mesh) {
  TraceEvent all = TraceEvent::array();
  for (const MeshPiece& piece : mesh.match.pieces) {
    TraceEvent its = topology_of(piece.topology);
    its["component"] = number_or_none(piece.component, kNoComponent);
    its["mixed"] = piece.mixed;
    its["vertices"] = piece.vertices;
    its["vertex"] = -1;
    all.push_back(std::move(its));
  }
  for (std::size_t v = 0; v < mesh.match.piece_of.size(); ++v) {
    const std::uint32_t piece = mesh.match.piece_of[v];
    if (piece != kNoPiece && all[piece]["vertex"] == -1) all[piece]["vertex"] = v;
  }
  return all;
}

}  // namespace

TraceEvent array_of(std::span<const Vec3> points) {
  TraceEvent all = TraceEvent::array();
  for (const Vec3& p : points) all.push_back(array_of(p));
  return all;
}

TraceEvent comparison_event(const ObservedComparison& comparison) {
  const MatchedMesh& mesh = comparison.mesh;
  return {{"e", "compare"},
          {"points", array_of(mesh.built.mesh.points)},
          {"triangles", mesh.built.mesh.triangles},
          {"components", components_of(comparison)},
          {"pieces", pieces_of(mesh)},
          {"error", mesh.match.error}};
}

TraceEvent sampling_event(const CellLevels& levels, std::span<const std::uint64_t> cells) {
  TraceEvent event{{"e", "sample"}, {"cells", TraceEvent::array()}, {"levels", TraceEvent::array()}};
  for (const CellName cell : std::set<CellName>(cells.begin(), cells.end())) {
    const auto found = levels.levels().find(cell);
    event["cells"].push_back(levels.cell(cell));
    event["levels"].push_back(found == levels.levels().end() ? 0 : found->second);
  }
  return event;
}

TraceEvent certificate_event(const PromiseFigures& figures, const Promise& promise) {
  return {{"e", "certify"},
          {"manifold", figures.is_manifold},
          {"misoriented", figures.misoriented_edges},
          {"reversed", figures.reversed_components},
          {"off_box", figures.off_box_edges},
          {"homeomorphic", figures.topology == Verdict::kHomeomorphic},
          {"crossing", figures.crossing_pairs},
          {"vertices_off", figures.vertices_off},
          {"mesh_off", figures.mesh_off},
          {"isosurface_off", figures.isosurface_off},
          {"max_residual", promise.max_residual},
          {"max_distance", promise.max_distance}};
}

}  // namespace deliso
