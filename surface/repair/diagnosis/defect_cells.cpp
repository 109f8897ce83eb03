#include "surface/repair/diagnosis/defect_cells.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "surface/certificate/mesh_pieces.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/signs/critical_points_in_cells.h"
#include "volume/topology/cell_crossings.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// Defects count within kNear layers of a box; within kVeryNear layers all active cells are taken.
constexpr std::int32_t kNear = 6;
constexpr std::int32_t kVeryNear = 3;
constexpr std::size_t kFewLikelyBoxes = 64;  // with more boxes, not all active cells around them are taken

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
        threads_(context.surface.threads),
        near_boxes_(context.boxes.size()),
        has_other_loops_(context.done.size(), false),
        has_defect_(context.done.size(), false) {
    for (std::size_t c = 0; c < has_other_loops_.size(); ++c) {
      const std::uint32_t piece = mesh_.match.main_piece[c];
      has_other_loops_[c] = piece != kNoPiece &&
                            mesh_.match.pieces[piece].topology.boundary_loops != topology_.components[c].boundary_loops;
    }
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
      // One whose topology is right in all has a mesh already, and is worth few more samples.
      if (!context.is_near_boxes && mesh_.match.agreement[c] != Agreement::kDisplaced) continue;
      // One layer more, for tests of cells whose points are not known yet.
      if (!boxes_[c].all.empty()) near_boxes_[c].emplace(boxes_[c].all, grid_.dims(), kNear + 1);
    }
  }

  std::vector<CellName> find() {
    flag_boxes();
    flag_mesh();
    flag_unused_vertices();
    flag_critical_points();
    flag_components_without_defects();
    return std::move(found_);
  }

 private:
  void flag_boxes();
  void flag_mesh();
  void flag_unused_vertices();
  void flag_critical_points();
  void flag_components_without_defects();
  // Cells whose critical points may matter, and for each a component that is not done.
  struct OpenCells {
    std::vector<CellIndex> cells;
    std::vector<std::uint32_t> components;
  };
  [[nodiscard]] OpenCells find_open_cells() const;
  [[nodiscard]] OpenCells find_open_cells(std::int32_t first_layer, std::int32_t last_layer) const;
  [[nodiscard]] std::optional<std::uint32_t> open_component_in(const CellIndex& cell) const;
  [[nodiscard]] Vec3 to_mesh_space(const Vec3& p) const { return scaled(p, restricted_.isosurface().step()); }

  // What a defect concerns. For a component whose piece has the right topology only some kinds matter.
  enum class DefectKind { kTopology, kMissingPart, kMixing };
  [[nodiscard]] bool matters(std::uint32_t component, DefectKind kind) const {
    if (component == kNoComponent || done_[component]) return false;
    const Agreement agreement = mesh_.match.agreement[component];
    if (agreement == Agreement::kMixed && kind != DefectKind::kMixing) return false;
    return agreement != Agreement::kPartial || kind == DefectKind::kMissingPart;
  }
  [[nodiscard]] bool is_near_boxes(const CellIndex& cell, std::uint32_t component, std::int32_t layers) const {
    return !near_boxes_[component] || (*near_boxes_[component])(cell) <= layers;
  }
  [[nodiscard]] bool is_at_box(const CellIndex& cell) const {
    bool is_at = false;
    for (std::size_t axis = 0; axis < 3; ++axis) is_at |= cell[axis] == 0 || cell[axis] == grid_.dims()[axis] - 2;
    return is_at;
  }
  // Euler curves tell little of boundary curves: where the mesh has one loop of two, the surfaces that it bounds may
  // have the same characteristic everywhere. So a component with other loops has its defects on the box, too.
  [[nodiscard]] bool matters(const Vec3& p, std::uint32_t component, DefectKind kind) const {
    if (!matters(component, kind)) return false;
    return (has_other_loops_[component] && SignedDelaunay::on_box(restricted_.isosurface().box(), p)) ||
           is_near_boxes(cells_.cell_of(p), component, kNear);
  }
  void flag(const Vec3& p, std::uint32_t component, DefectKind kind) {
    if (!matters(p, component, kind)) return;
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
  int threads_;
  std::vector<std::optional<DistanceFromRanges>> near_boxes_;  // of each exact component
  std::vector<bool> has_other_loops_;                          // of each exact component: than its main piece
  std::vector<bool> has_defect_;                               // of each exact component
  std::vector<CellName> found_;
};

void DefectFinder::flag_boxes() {
  for (std::uint32_t c = 0; c < boxes_.size(); ++c) {
    if (done_[c] || boxes_[c].likely.size() > kFewLikelyBoxes) continue;
    for (const auto& [x, y, z] : boxes_[c].likely) {
      const CellIndex low = {x.first - kVeryNear, y.first - kVeryNear, z.first - kVeryNear};
      const CellIndex high = {x.last + kVeryNear, y.last + kVeryNear, z.last + kVeryNear};
      cells_.append_active_cells(topology_.index, low, high, found_);
    }
  }
}

// Flags pinches, triangles between components, and stray pieces.
void DefectFinder::flag_mesh() {
  const SurfaceMesh& surface = mesh_.built.mesh;
  const ComponentMatch& match = mesh_.match;
  for (const std::uint32_t v : mesh_.built.copies) flag(surface.points[v], mesh_.component[v], DefectKind::kTopology);
  for (const auto& v : surface.triangles) {
    const std::uint32_t piece = match.piece_of[v[0]];
    const bool is_stray = !match.is_main(piece);
    const bool is_between =
        mesh_.component[v[0]] != mesh_.component[v[1]] || mesh_.component[v[0]] != mesh_.component[v[2]];
    if (!is_stray && !is_between) continue;
    const DefectKind kind = is_between ? DefectKind::kMixing : DefectKind::kMissingPart;
    const Vec3 centroid = (surface.points[v[0]] + surface.points[v[1]] + surface.points[v[2]]) / 3;
    flag(centroid, mesh_.component[v[0]], kind);
    for (const std::uint32_t q : v) flag(surface.points[q], mesh_.component[q], kind);
  }
}

void DefectFinder::flag_unused_vertices() {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  std::vector<bool> used(delaunay.vertex_count(), false);
  for (const VertexId v : mesh_.built.vertex_of) used[v.index()] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_.is_virtual(VertexId(i))) continue;
    flag(delaunay.point(VertexId(i)), component_of_vertex_[i], DefectKind::kMissingPart);
  }
}

// Flags critical points on the wrong side of the mesh. There a tunnel is open that should be closed, or closed that
// should be open.
void DefectFinder::flag_critical_points() {
  const OpenCells open = find_open_cells();
  std::vector<CriticalPointInCell> points = critical_points_in(open.cells, restricted_.isosurface(), threads_);
  std::erase_if(points,
                [&](const auto& p) { return !matters(p.point, open.components[p.cell], DefectKind::kTopology); });
  const std::vector<TetId> tets = tets_at(points, open.cells, restricted_, threads_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (restricted_.is_above(tets[i]) == points[i].is_above) continue;
    flag(points[i].point, open.components[points[i].cell], DefectKind::kTopology);
  }
}

DefectFinder::OpenCells DefectFinder::find_open_cells() const {
  std::vector<OpenCells> of_slabs(slab_count(topology_.index.cell_layers()));
  for_each_slab(topology_.index.cell_layers(), threads_, [&](std::size_t slab, std::int32_t first, std::int32_t last) {
    of_slabs[slab] = find_open_cells(first, last);
  });
  OpenCells open;
  for (const OpenCells& some : of_slabs) {
    open.cells.insert(open.cells.end(), some.cells.begin(), some.cells.end());
    open.components.insert(open.components.end(), some.components.begin(), some.components.end());
  }
  return open;
}

// Those in some layers across z.
DefectFinder::OpenCells DefectFinder::find_open_cells(std::int32_t first_layer, std::int32_t last_layer) const {
  OpenCells open;
  CellCrossings crossings(topology_.index);
  topology_.index.for_each_active_cell(first_layer, last_layer, [&](const CellIndex& cell, std::uint8_t pattern) {
    std::optional<std::uint32_t> component;
    if (is_simple(pattern)) {  // one disk
      crossings.move_to(cell);
      component = topology_.crossings[crossings.number(std::countr_zero(crossed_edges(pattern)))].component;
    } else {
      component = open_component_in(cell);
    }
    if (!component || !matters(*component, DefectKind::kTopology)) return;
    if (!(has_other_loops_[*component] && is_at_box(cell)) && !is_near_boxes(cell, *component, kNear + 1)) return;
    open.cells.push_back(cell);
    open.components.push_back(*component);
  });
  return open;
}

// A component that is not done and has a crossing on an edge of the cell.
std::optional<std::uint32_t> DefectFinder::open_component_in(const CellIndex& cell) const {
  std::optional<std::uint32_t> open;
  topology_.index.for_each_crossing_of_cell(cell, [&](std::uint32_t crossing) {
    const std::uint32_t component = topology_.crossings[crossing].component;
    if (!open && !done_[component]) open = component;
  });
  return open;
}

void DefectFinder::flag_components_without_defects() {
  const std::vector<bool> had_defect = has_defect_;
  for (const SurfaceSaddle& saddle : topology_.saddles) {
    if (!had_defect[saddle.component]) flag(to_mesh_space(saddle.position), saddle.component, DefectKind::kTopology);
  }
  const std::vector<bool> had_saddle = has_defect_;
  for (const EdgeCrossing& crossing : topology_.crossings) {
    if (had_saddle[crossing.component]) continue;
    const bool is_partial = mesh_.match.agreement[crossing.component] == Agreement::kPartial;
    flag(to_mesh_space(crossing_position(grid_, crossing)), crossing.component,
         is_partial ? DefectKind::kMissingPart : DefectKind::kTopology);
  }
}

}  // namespace

std::vector<CellName> defect_cells(const DefectContext& context) { return DefectFinder(context).find(); }

}  // namespace deliso
