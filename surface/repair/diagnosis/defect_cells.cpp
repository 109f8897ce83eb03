#include "surface/repair/diagnosis/defect_cells.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/signs/sign_constraints.h"
#include "volume/topology/cell_crossings.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// How many layers from a place trouble is looked for, and how many all active cells are taken.
constexpr std::int32_t kNear = 6;
constexpr std::int32_t kVeryNear = 3;
constexpr std::size_t kFewPlaces = 64;  // where all active cells are taken, at most

class TroubleFinder {
 public:
  explicit TroubleFinder(const DefectContext& context)
      : grid_(context.surface.grid()),
        topology_(context.surface.topology),
        restricted_(context.restricted),
        mesh_(context.mesh),
        cells_(context.cells),
        component_of_vertex_(context.component_of_vertex),
        done_(context.done),
        places_(context.places),
        evidence_(context.evidence),
        critical_(context.critical),
        threads_(context.surface.threads),
        near_places_(context.places.size()),
        has_sign_(context.done.size(), false) {
    for (std::size_t c = 0; context.is_near_places && c < places_.size(); ++c) {
      // One layer more is asked for where points are not known yet, only their cells.
      if (!places_[c].all.empty()) near_places_[c].emplace(places_[c].all, grid_.dims(), kNear + 1);
    }
  }

  std::vector<CellName> find() {
    flag_places();
    flag_mesh();
    flag_conflicts();
    flag_unused_vertices();
    flag_critical_points();
    flag_silent_components();
    return std::move(found_);
  }

 private:
  void flag_places();
  void flag_mesh();
  void flag_conflicts();
  void flag_unused_vertices();
  void flag_critical_points();
  void flag_silent_components();
  void find_open_cells(std::vector<CellIndex>& cells, std::vector<std::uint32_t>& components) const;
  [[nodiscard]] std::optional<std::uint32_t> open_component_in(const CellIndex& cell) const;
  [[nodiscard]] Vec3 to_mesh_space(const Vec3& p) const { return scaled(p, restricted_.isosurface().step()); }

  // What a sign of trouble tells of: of a component whose piece has the right topology only some signs matter.
  enum class Tells { kTopology, kMissingPart, kMixing };
  [[nodiscard]] bool matters(std::uint32_t component, Tells tells) const {
    if (done_[component]) return false;
    const Agreement agreement = mesh_.match.agreement[component];
    if (agreement == Agreement::kMixed && tells != Tells::kMixing) return false;
    return agreement != Agreement::kPartial || tells == Tells::kMissingPart;
  }
  [[nodiscard]] bool is_near_places(const CellIndex& cell, std::uint32_t component, std::int32_t layers) const {
    return !near_places_[component] || (*near_places_[component])(cell) <= layers;
  }
  [[nodiscard]] bool matters(const Vec3& p, std::uint32_t component, Tells tells) const {
    return matters(component, tells) && is_near_places(cells_.cell_of(p), component, kNear);
  }
  void flag(const Vec3& p, std::uint32_t component, Tells tells) {
    if (!matters(p, component, tells)) return;
    has_sign_[component] = true;
    cells_.append_cells_of(p, found_);
  }

  const ScalarGrid& grid_;
  const IsosurfaceTopology& topology_;
  const SignedDelaunay& restricted_;
  const MatchedMesh& mesh_;
  const CellLevels& cells_;
  const std::vector<std::uint32_t>& component_of_vertex_;
  const std::vector<bool>& done_;
  const std::vector<IndexRanges>& places_;  // of each exact component
  std::span<const std::uint8_t> evidence_;
  LocatedCriticalPoints& critical_;
  int threads_;
  std::vector<std::optional<DistanceFromRanges>> near_places_;  // of each exact component
  std::vector<bool> has_sign_;                                  // of each exact component
  std::vector<CellName> found_;
};

void TroubleFinder::flag_places() {
  for (std::uint32_t c = 0; c < places_.size(); ++c) {
    const std::vector<IndexBox>& likely = places_[c].likely;
    if (done_[c] || likely.empty() || likely.size() > kFewPlaces) continue;
    for (const IndexBox& place : likely) {
      const CellLayers near(grid_.dims(), [&](std::size_t axis, std::int32_t layer) {
        return place[axis].first - kVeryNear <= layer && layer <= place[axis].last + kVeryNear;
      });
      near.for_each_active_cell(topology_.index,
                                [&](const CellIndex& cell, unsigned) { found_.push_back(cells_.name(cell)); });
    }
  }
}

// Split vertices, triangles between components, and strays.
void TroubleFinder::flag_mesh() {
  const SurfaceMesh& surface = mesh_.built.mesh;
  const ComponentMatch& match = mesh_.match;
  for (const std::uint32_t v : mesh_.built.copies) flag(surface.points[v], mesh_.component[v], Tells::kTopology);
  for (const auto& v : surface.triangles) {
    const std::uint32_t piece = match.piece_of[v[0]];
    const bool is_stray = match.main_piece[match.pieces[piece].component] != piece;
    const bool is_between =
        mesh_.component[v[0]] != mesh_.component[v[1]] || mesh_.component[v[0]] != mesh_.component[v[2]];
    if (!is_stray && !is_between) continue;
    const Tells tells = is_between ? Tells::kMixing : Tells::kMissingPart;
    const Vec3 centroid = (surface.points[v[0]] + surface.points[v[1]] + surface.points[v[2]]) / 3;
    flag(centroid, mesh_.component[v[0]], tells);
    for (const std::uint32_t q : v) flag(surface.points[q], mesh_.component[q], tells);
  }
}

// Tetrahedra that reach from one side of the isovalue to the other.
void TroubleFinder::flag_conflicts() {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    if (evidence_[i] != kConflict || delaunay.is_ghost(TetId(i))) continue;
    const auto& v = delaunay.vertices(TetId(i));
    for (unsigned a = 0; a < 4; ++a) {
      for (unsigned b = 0; b <= a; ++b) {
        if (restricted_.is_virtual(v[a]) || restricted_.is_virtual(v[b])) continue;
        flag(0.5 * (delaunay.point(v[a]) + delaunay.point(v[b])), component_of_vertex_[v[a].index()], Tells::kTopology);
      }
    }
  }
}

void TroubleFinder::flag_unused_vertices() {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  std::vector<bool> used(delaunay.vertex_count(), false);
  for (const VertexId v : mesh_.built.vertex_of) used[v.index()] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_.is_virtual(VertexId(i))) continue;
    flag(delaunay.point(VertexId(i)), component_of_vertex_[i], Tells::kMissingPart);
  }
}

// Critical points that the mesh leaves on the wrong side: there a tunnel is open that should be closed, or the other
// way.
void TroubleFinder::flag_critical_points() {
  std::vector<CellIndex> cells;
  std::vector<std::uint32_t> open;  // the component of each that is not done
  find_open_cells(cells, open);
  critical_.find(cells, threads_);
  const std::vector<LocatedCriticalPoint>& places = critical_.places();
  std::vector<std::uint32_t> wanted;
  std::vector<std::uint32_t> component_of;  // of each of these
  for (std::size_t i = 0, at = 0; i < places.size(); ++i) {
    while (at < cells.size() && is_before(cells[at], places[i].cell)) ++at;
    if (at == cells.size()) break;
    if (cells[at] != places[i].cell || !matters(places[i].point, open[at], Tells::kTopology)) continue;
    wanted.push_back(static_cast<std::uint32_t>(i));
    component_of.push_back(open[at]);
  }
  critical_.locate(wanted, threads_);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const LocatedCriticalPoint& place = places[wanted[k]];
    if (restricted_.is_above(critical_.tet(wanted[k])) == place.is_above) continue;
    flag(place.point, component_of[k], Tells::kTopology);
  }
}

// The active cells in which critical points may matter, and a component for each.
void TroubleFinder::find_open_cells(std::vector<CellIndex>& cells, std::vector<std::uint32_t>& components) const {
  const CrossingIndex& index = topology_.index;
  std::vector<std::uint32_t> counting;
  for (std::uint32_t c = 0; c < done_.size(); ++c) {
    if (matters(c, Tells::kTopology)) counting.push_back(c);
  }
  if (counting.empty()) return;
  const CellLayers layers(grid_.dims(), [&](std::size_t axis, std::int32_t layer) {
    return std::any_of(counting.begin(), counting.end(),
                       [&](std::uint32_t c) { return !near_places_[c] || near_places_[c]->reaches(axis, layer); });
  });
  CellCrossings crossings(index);
  layers.for_each_active_cell(index, [&](const CellIndex& cell, std::uint8_t pattern) {
    std::optional<std::uint32_t> component;
    if (is_simple(pattern)) {  // one disk
      crossings.move_to(cell);
      component = topology_.crossings[crossings.number(std::countr_zero(crossed_edges(pattern)))].component;
    } else {
      component = open_component_in(cell);
    }
    if (!component || !matters(*component, Tells::kTopology) || !is_near_places(cell, *component, kNear + 1)) return;
    cells.push_back(cell);
    components.push_back(*component);
  });
}

void TroubleFinder::flag_silent_components() {
  const std::vector<bool> had_sign = has_sign_;
  for (const SurfaceSaddle& saddle : topology_.saddles) {
    if (!had_sign[saddle.component]) flag(to_mesh_space(saddle.position), saddle.component, Tells::kTopology);
  }
  const std::vector<bool> had_saddle = has_sign_;
  for (const EdgeCrossing& crossing : topology_.crossings) {
    if (had_saddle[crossing.component]) continue;
    const bool is_partial = mesh_.match.agreement[crossing.component] == Agreement::kPartial;
    flag(to_mesh_space(crossing_position(grid_, crossing)), crossing.component,
         is_partial ? Tells::kMissingPart : Tells::kTopology);
  }
}

// A component with a crossing on the edges of an active cell that is not done.
std::optional<std::uint32_t> TroubleFinder::open_component_in(const CellIndex& cell) const {
  std::optional<std::uint32_t> open;
  topology_.index.for_each_crossing_of_cell(cell, [&](std::uint32_t crossing) {
    const std::uint32_t component = topology_.crossings[crossing].component;
    if (!open && !done_[component]) open = component;
  });
  return open;
}

}  // namespace

std::vector<CellName> defect_cells(const DefectContext& context) { return TroubleFinder(context).find(); }

}  // namespace deliso
