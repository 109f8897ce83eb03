#include "surface/repair/diagnosis/defect_cells.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "surface/certificate/mesh_pieces.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "volume/topology/cell_crossings.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// How many layers from a box defects are looked for, and how many all active cells are taken.
constexpr std::int32_t kNear = 6;
constexpr std::int32_t kVeryNear = 3;
constexpr std::size_t kFewBoxes = 64;  // around which all active cells are taken, at most

class DefectFinder {
 public:
  explicit DefectFinder(const DefectContext& context)
      : grid_(context.surface.grid()),
        topology_(context.surface.topology),
        restricted_(context.restricted),
        mesh_(context.mesh),
        cells_(context.cells),
        component_of_vertex_(context.component_of_vertex),
        done_(context.done),
        boxes_(context.boxes),
        critical_(context.critical),
        threads_(context.surface.threads),
        near_boxes_(context.boxes.size()),
        has_defect_(context.done.size(), false) {
    for (std::size_t c = 0; context.is_near_boxes && c < boxes_.size(); ++c) {
      // One layer more is asked for where points are not known yet, only their cells.
      if (!boxes_[c].all.empty()) near_boxes_[c].emplace(boxes_[c].all, grid_.dims(), kNear + 1);
    }
  }

  std::vector<CellName> find() {
    flag_boxes();
    flag_mesh();
    flag_unused_vertices();
    flag_critical_points();
    flag_silent_components();
    return std::move(found_);
  }

 private:
  void flag_boxes();
  void flag_mesh();
  void flag_unused_vertices();
  void flag_critical_points();
  void flag_silent_components();
  void find_open_cells(std::vector<CellIndex>& cells, std::vector<std::uint32_t>& components) const;
  [[nodiscard]] std::optional<std::uint32_t> open_component_in(const CellIndex& cell) const;
  [[nodiscard]] Vec3 to_mesh_space(const Vec3& p) const { return scaled(p, restricted_.isosurface().step()); }

  // What a defect tells of: of a component whose piece has the right topology only some defects matter.
  enum class Tells { kTopology, kMissingPart, kMixing };
  [[nodiscard]] bool matters(std::uint32_t component, Tells tells) const {
    if (component == kNoComponent || done_[component]) return false;
    const Agreement agreement = mesh_.match.agreement[component];
    if (agreement == Agreement::kMixed && tells != Tells::kMixing) return false;
    return agreement != Agreement::kPartial || tells == Tells::kMissingPart;
  }
  [[nodiscard]] bool is_near_boxes(const CellIndex& cell, std::uint32_t component, std::int32_t layers) const {
    return !near_boxes_[component] || (*near_boxes_[component])(cell) <= layers;
  }
  [[nodiscard]] bool matters(const Vec3& p, std::uint32_t component, Tells tells) const {
    return matters(component, tells) && is_near_boxes(cells_.cell_of(p), component, kNear);
  }
  void flag(const Vec3& p, std::uint32_t component, Tells tells) {
    if (!matters(p, component, tells)) return;
    has_defect_[component] = true;
    cells_.append_cells_of(p, found_);
  }

  const ScalarGrid& grid_;
  const IsosurfaceTopology& topology_;
  const SignedDelaunay& restricted_;
  const MatchedMesh& mesh_;
  const CellLevels& cells_;
  const std::vector<std::uint32_t>& component_of_vertex_;
  const std::vector<bool>& done_;
  const std::vector<IndexRanges>& boxes_;  // of each exact component
  LocatedCriticalPoints& critical_;
  int threads_;
  std::vector<std::optional<DistanceFromRanges>> near_boxes_;  // of each exact component
  std::vector<bool> has_defect_;                               // of each exact component
  std::vector<CellName> found_;
};

void DefectFinder::flag_boxes() {
  for (std::uint32_t c = 0; c < boxes_.size(); ++c) {
    if (done_[c] || boxes_[c].likely.size() > kFewBoxes) continue;
    for (const auto& [x, y, z] : boxes_[c].likely) {
      const CellIndex low = {x.first - kVeryNear, y.first - kVeryNear, z.first - kVeryNear};
      const CellIndex high = {x.last + kVeryNear, y.last + kVeryNear, z.last + kVeryNear};
      cells_.append_active_cells(topology_.index, low, high, found_);
    }
  }
}

// Split vertices, triangles between components, and strays.
void DefectFinder::flag_mesh() {
  const SurfaceMesh& surface = mesh_.built.mesh;
  const ComponentMatch& match = mesh_.match;
  for (const std::uint32_t v : mesh_.built.copies) flag(surface.points[v], mesh_.component[v], Tells::kTopology);
  for (const auto& v : surface.triangles) {
    const std::uint32_t piece = match.piece_of[v[0]];
    const bool is_stray = !match.is_main(piece);
    const bool is_between =
        mesh_.component[v[0]] != mesh_.component[v[1]] || mesh_.component[v[0]] != mesh_.component[v[2]];
    if (!is_stray && !is_between) continue;
    const Tells tells = is_between ? Tells::kMixing : Tells::kMissingPart;
    const Vec3 centroid = (surface.points[v[0]] + surface.points[v[1]] + surface.points[v[2]]) / 3;
    flag(centroid, mesh_.component[v[0]], tells);
    for (const std::uint32_t q : v) flag(surface.points[q], mesh_.component[q], tells);
  }
}

void DefectFinder::flag_unused_vertices() {
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
void DefectFinder::flag_critical_points() {
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
void DefectFinder::find_open_cells(std::vector<CellIndex>& cells, std::vector<std::uint32_t>& components) const {
  CellCrossings crossings(topology_.index);
  topology_.index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) {
    std::optional<std::uint32_t> component;
    if (is_simple(pattern)) {  // one disk
      crossings.move_to(cell);
      component = topology_.crossings[crossings.number(std::countr_zero(crossed_edges(pattern)))].component;
    } else {
      component = open_component_in(cell);
    }
    if (!component || !matters(*component, Tells::kTopology) || !is_near_boxes(cell, *component, kNear + 1)) return;
    cells.push_back(cell);
    components.push_back(*component);
  });
}

// A component with a crossing on the edges of an active cell that is not done.
std::optional<std::uint32_t> DefectFinder::open_component_in(const CellIndex& cell) const {
  std::optional<std::uint32_t> open;
  topology_.index.for_each_crossing_of_cell(cell, [&](std::uint32_t crossing) {
    const std::uint32_t component = topology_.crossings[crossing].component;
    if (!open && !done_[component]) open = component;
  });
  return open;
}

void DefectFinder::flag_silent_components() {
  const std::vector<bool> had_defect = has_defect_;
  for (const SurfaceSaddle& saddle : topology_.saddles) {
    if (!had_defect[saddle.component]) flag(to_mesh_space(saddle.position), saddle.component, Tells::kTopology);
  }
  const std::vector<bool> had_saddle = has_defect_;
  for (const EdgeCrossing& crossing : topology_.crossings) {
    if (had_saddle[crossing.component]) continue;
    const bool is_partial = mesh_.match.agreement[crossing.component] == Agreement::kPartial;
    flag(to_mesh_space(crossing_position(grid_, crossing)), crossing.component,
         is_partial ? Tells::kMissingPart : Tells::kTopology);
  }
}

}  // namespace

std::vector<CellName> defect_cells(const DefectContext& context) { return DefectFinder(context).find(); }

}  // namespace deliso
