#include "surface/trouble.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <optional>

#include "surface/blocks.h"
#include "surface/evidence.h"
#include "surface/sample_locator.h"
#include "volume/critical_points.h"

namespace deliso {

std::int32_t Places::distance(const CellIndex& cell) const {
  std::int32_t farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
    for (const std::int32_t layer : layers[axis]) nearest = std::min(nearest, std::abs(cell[axis] - layer));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

namespace {

// How many layers from a place trouble is looked for, and how many all active cells are taken.
constexpr std::int32_t kNear = 6;
constexpr std::int32_t kVeryNear = 3;
constexpr std::size_t kCellsAtOnce = 4096;       // with critical points, that one thread takes at a time
constexpr std::size_t kCellsInMemory = 1 << 18;  // whose critical points are kept at a time
constexpr std::size_t kFewPlaces = 8;  // at most so many, for some are where jumps along the axes cross by chance

class TroubleFinder {
 public:
  TroubleFinder(const TroubleContext& context, int threads)
      : threads_(threads),
        grid_(context.grid),
        topology_(context.topology),
        restricted_(context.restricted),
        mesh_(context.mesh),
        cells_(context.cells),
        component_of_vertex_(context.component_of_vertex),
        done_(context.done),
        places_(context.places),
        critical_cells_(context.critical_cells),
        evidence_(context.evidence),
        has_sign_(context.done.size(), false) {}

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
  [[nodiscard]] std::optional<std::uint32_t> open_component_in(const CellIndex& cell) const;
  [[nodiscard]] Vec3 to_mesh_space(const Vec3& p) const { return scaled(p, restricted_.isosurface().step()); }

  // What a sign of trouble tells of: of a component whose piece has the right topology only some signs matter.
  enum class Tells { kTopology, kMissingPart, kMixing };
  void flag(const Vec3& p, std::uint32_t component, Tells tells) {
    if (done_[component]) return;
    const Agreement agreement = mesh_.match.agreement[component];
    if (agreement == Agreement::kMixed && tells != Tells::kMixing) return;
    if (agreement == Agreement::kPartial && tells != Tells::kMissingPart) return;
    if (!places_[component].empty() && !places_[component].near(cells_.cell_of(p), kNear)) return;
    has_sign_[component] = true;
    cells_.append_cells_of(p, found_);
  }

  // A saddle, or a critical sample, in or at an active cell of a component that is not done.
  struct CriticalPlace {
    Vec3 point;  // in mesh space
    std::uint32_t component = 0;
    bool is_above = false;
    SampleLocator::Located at;
  };
  void append_critical_places(const CellIndex& cell, SampleLocator& locator, std::vector<CriticalPoint>& saddles,
                              std::vector<CriticalPlace>& places) const;

  int threads_;
  const ScalarGrid& grid_;
  const IsosurfaceTopology& topology_;
  const SignedDelaunay& restricted_;
  const MatchedMesh& mesh_;
  const RaisedCells& cells_;
  const std::vector<std::uint32_t>& component_of_vertex_;
  const std::vector<bool>& done_;
  const std::vector<Places>& places_;  // of each exact component
  const std::vector<CellIndex>& critical_cells_;
  std::span<const std::uint8_t> evidence_;
  std::vector<bool> has_sign_;  // of each exact component
  std::vector<CellName> found_;
};

void TroubleFinder::flag_places() {
  for (std::uint32_t c = 0; c < places_.size(); ++c) {
    if (done_[c] || places_[c].empty() || places_[c].count() > kFewPlaces) continue;
    topology_.index.for_each_active_cell([&](const CellIndex& cell, unsigned) {
      if (places_[c].near(cell, kVeryNear)) found_.push_back(cells_.name(cell));
    });
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

// Locates the critical points of a cell, each from the one before.
void TroubleFinder::append_critical_places(const CellIndex& cell, SampleLocator& locator,
                                           std::vector<CriticalPoint>& saddles,
                                           std::vector<CriticalPlace>& places) const {
  const auto component = open_component_in(cell);
  if (!component) return;
  const auto hint = [&] {
    return places.empty() ? restricted_.delaunay().incident_tet(VertexId(std::size_t{0})) : places.back().at.tet;
  };
  const double isovalue = restricted_.isosurface().isovalue();
  const CellCorners corners = grid_.cell(cell[0], cell[1], cell[2]);
  saddles.clear();
  append_critical_points(corners, saddles);
  for (const CriticalPoint& saddle : saddles) {
    const int side = side_of_saddle(corners, isovalue, saddle);
    if (side == 0) continue;
    const Vec3 p = to_mesh_space({cell[0] + saddle.uvw.x, cell[1] + saddle.uvw.y, cell[2] + saddle.uvw.z});
    places.push_back({p, *component, side > 0, locator.locate_settled(p, hint())});
  }
  for (unsigned critical = critical_corners(grid_, cell); critical != 0; critical &= critical - 1) {
    const auto corner = static_cast<unsigned>(std::countr_zero(critical));
    const CellIndex sample{cell[0] + static_cast<int>(corner & 1u), cell[1] + static_cast<int>(corner >> 1 & 1u),
                           cell[2] + static_cast<int>(corner >> 2)};
    const Vec3 p{static_cast<double>(sample[0]), static_cast<double>(sample[1]), static_cast<double>(sample[2])};
    places.push_back(
        {to_mesh_space(p), *component, corners[corner] > isovalue, locator.locate_settled(sample, hint())});
  }
}

// Critical points that the mesh leaves on the wrong side: there a tunnel is open that should be closed, or the other
// way. Points on facets go to the tetrahedron that a walk from the point before finds; so they are located again, in
// order.
void TroubleFinder::flag_critical_points() {
  TetId hint = restricted_.delaunay().incident_tet(VertexId(std::size_t{0}));
  for (std::size_t begin = 0; begin < critical_cells_.size(); begin += kCellsInMemory) {
    const std::size_t count = std::min(kCellsInMemory, critical_cells_.size() - begin);
    std::vector<std::vector<CriticalPlace>> blocks((count + kCellsAtOnce - 1) / kCellsAtOnce);
    const auto locate = [&](std::size_t first, std::size_t last) {
      SampleLocator locator(restricted_, grid_);
      std::vector<CriticalPoint> saddles;
      for (std::size_t i = first; i < last; ++i) {
        append_critical_places(critical_cells_[begin + i], locator, saddles, blocks[first / kCellsAtOnce]);
      }
    };
    for_each_block(count, threads_, locate, kCellsAtOnce);
    for (const std::vector<CriticalPlace>& places : blocks) {
      for (const CriticalPlace& place : places) {
        hint = place.at.is_settled ? place.at.tet : restricted_.locate(place.point, hint);
        if (restricted_.is_above(hint) != place.is_above) flag(place.point, place.component, Tells::kTopology);
      }
    }
  }
}

void TroubleFinder::flag_silent_components() {
  const std::vector<bool> had_sign = has_sign_;
  for (const SurfaceSaddle& saddle : topology_.saddles) {
    if (!had_sign[saddle.component]) flag(to_mesh_space(saddle.position), saddle.component, Tells::kTopology);
  }
  const std::vector<bool> had_saddle = has_sign_;
  for (const EdgeCrossing& crossing : topology_.crossings) {
    if (!had_saddle[crossing.component])
      flag(to_mesh_space(crossing_position(grid_, crossing)), crossing.component, Tells::kTopology);
  }
}

// A component with a crossing on the edges of an active cell that is not done.
std::optional<std::uint32_t> TroubleFinder::open_component_in(const CellIndex& cell) const {
  for (std::int32_t edge = 0; edge < 12; ++edge) {
    const auto axis = static_cast<std::size_t>(edge / 4);
    CellIndex sample = cell;
    sample[(axis + 1) % 3] += edge & 1;
    sample[(axis + 2) % 3] += edge >> 1 & 1;
    const std::uint32_t crossing = topology_.index.find(sample[0], sample[1], sample[2], static_cast<int>(axis));
    if (crossing == CrossingIndex::kNone) continue;
    const std::uint32_t component = topology_.crossings[crossing].component;
    if (!done_[component]) return component;
  }
  return std::nullopt;
}

}  // namespace

std::vector<CellName> cells_in_trouble(const TroubleContext& context, int threads) {
  return TroubleFinder(context, threads).find();
}

}  // namespace deliso
