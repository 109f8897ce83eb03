#include "surface/repair.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <cstdio>
#include <cstdlib>

#include "surface/founded_signs.h"
#include "surface/poles.h"
#include "surface/sample_lattice.h"
#include "volume/critical_points.h"

namespace deliso {

namespace {

// Tetrahedra with an edge longer than this (mesh-space units) keep the sign of their circumcenter everywhere.
constexpr double kLongEdge = 2;
// A triangle whose normal makes a smaller cosine with the gradient is a sign of trouble.
constexpr double kSmallCosine = 0.3;
// From this level on neighbouring cells may differ by one level only.
constexpr int kGradedLevel = 3;
// A point this near to a side of its cell (in index space) lies on that side.
constexpr double kOnSide = 1e-6;

// A mesh with the pole height of each vertex, and what it was matched with.
struct RepairedMesh {
  BuiltMesh built;
  ComponentMatch match;
  std::vector<std::uint32_t> component;  // of each mesh vertex: the exact component it lies on
};

class Repair {
 public:
  Repair(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology, RepairStats& stats)
      : grid_(grid),
        isosurface_(isosurface),
        topology_(topology),
        stats_(stats),
        lattice_(grid, isosurface.isovalue(), topology) {}

  SurfaceMesh run(std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls);

 private:
  struct Sample {
    Vec3 point;             // in mesh space
    std::uint64_t key = 0;  // of a lattice sample; 0 for a free one
  };

  [[nodiscard]] bool is_done() const;
  void keep_matched(const RepairedMesh& mesh);
  void keep_rest(const RepairedMesh& mesh);
  void take_samples(const SignedDelaunay& restricted);
  RepairedMesh assemble(const SignedDelaunay& restricted);
  void flag_trouble(const SignedDelaunay& restricted, const RepairedMesh& mesh);
  void flag_mesh(const RepairedMesh& mesh);
  void flag_lost_samples(const SignedDelaunay& restricted, const RepairedMesh& mesh);
  void flag_critical_points(const SignedDelaunay& restricted);
  void flag_by_default();
  void flag_point(const Vec3& p, std::uint32_t component);
  void raise_flagged();
  void grade();
  void resample();
  std::unique_ptr<SignedDelaunay> rebuild();
  void take_signs_at_centroids(SignedDelaunay& restricted) const;

  [[nodiscard]] Vec3 to_index_space(const Vec3& p) const {
    const Vec3& step = isosurface_.step();
    return {p.x / step.x, p.y / step.y, p.z / step.z};
  }
  [[nodiscard]] std::uint32_t component_in(const CellIndex& cell) const;
  [[nodiscard]] CellIndex cell_of(const Vec3& index_point) const;
  [[nodiscard]] std::uint64_t name(const CellIndex& c) const { return grid_.index(c[0], c[1], c[2]); }
  [[nodiscard]] CellIndex cell_named(std::uint64_t name) const;
  template <class Visit>
  void for_each_neighbour(const CellIndex& cell, Visit visit) const;

  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  const IsosurfaceTopology& topology_;
  RepairStats& stats_;
  SampleLattice lattice_;

  std::vector<Sample> samples_;
  std::unordered_map<std::uint64_t, int> level_;  // of each raised cell
  std::unordered_set<std::uint64_t> flagged_;
  std::vector<bool> component_flagged_;
  std::vector<bool> done_;  // of each exact component: kept_ holds its piece
  SurfaceMesh kept_;
};

SurfaceMesh Repair::run(std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls) {
  take_samples(*restricted);
  stats_.points_before = stats_.points_after = static_cast<std::int64_t>(samples_.size());
  overturn_unfounded_signs(*restricted, grid_);
  RepairedMesh mesh = assemble(*restricted);
  stats_.unmatched_before = mesh.match.unmatched_components;
  if (mesh.match.complete()) return std::move(mesh.built.mesh);
  keep_matched(mesh);
  RepairedMesh best = mesh;
  for (std::int32_t round = 1; round <= max_rounds && !is_done() && !controls.stopped(); ++round) {
    // Flag where components differ, raise those cells, rebuild.
    flag_trouble(*restricted, mesh);
    if (flagged_.empty()) break;
    raise_flagged();
    resample();
    restricted.reset();
    restricted = rebuild();
    mesh = assemble(*restricted);
    keep_matched(mesh);
    stats_.rounds = round;
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh.match.error()));
    if (mesh.match.error() < best.match.error()) best = mesh;
  }
  keep_rest(best);
  return std::move(kept_);
}

bool Repair::is_done() const { return std::all_of(done_.begin(), done_.end(), [](bool d) { return d; }); }

// A component keeps the piece of the first round in which it matches.
void Repair::keep_matched(const RepairedMesh& mesh) {
  done_.resize(topology_.components.size(), false);
  std::vector<bool> wanted(mesh.match.pieces.size(), false);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const MeshPiece& piece = mesh.match.pieces[i];
    if (!piece.matched || done_[piece.component]) continue;
    wanted[i] = true;
    done_[piece.component] = true;
  }
  append_pieces(mesh.built.mesh, mesh.match.piece_of, wanted, kept_);
}

// Components that never matched are taken as the best round has them.
void Repair::keep_rest(const RepairedMesh& mesh) {
  std::vector<bool> wanted(mesh.match.pieces.size(), false);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = !done_[mesh.match.pieces[i].component];
  append_pieces(mesh.built.mesh, mesh.match.piece_of, wanted, kept_);
  stats_.unmatched_after = std::count(done_.begin(), done_.end(), false);
  stats_.points_after = static_cast<std::int64_t>(kept_.points.size());
}

void Repair::take_samples(const SignedDelaunay& restricted) {
  samples_.clear();
  const auto& points = restricted.delaunay().points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!restricted.is_virtual(VertexId(i))) samples_.push_back({points[i], 0});
  }
}

// The mesh, its pole heights and its match with the exact components.
RepairedMesh Repair::assemble(const SignedDelaunay& restricted) {
  RepairedMesh mesh{build_triangle_mesh(restricted), {}, {}};
  const std::vector<double> heights = compute_poles(restricted);
  std::vector<std::uint32_t> component;
  for (const VertexId v : mesh.built.vertex_of) {
    mesh.built.mesh.pole_heights.push_back(heights[v.index()]);
    const Vec3 p = to_index_space(restricted.delaunay().point(v));
    component.push_back(component_of(grid_, isosurface_.isovalue(), topology_, p).value_or(0));
  }
  mesh.match = match_components(mesh.built.mesh, component, topology_.components);
  mesh.component = std::move(component);
  return mesh;
}

void Repair::flag_trouble(const SignedDelaunay& restricted, const RepairedMesh& mesh) {
  flagged_.clear();
  component_flagged_.assign(topology_.components.size(), false);
  flag_mesh(mesh);
  flag_lost_samples(restricted, mesh);
  if (!getenv("NOCRIT")) flag_critical_points(restricted);
  flag_by_default();
}

// Split vertices, triangles between components, triangles that stand across the surface, and stray pieces.
void Repair::flag_mesh(const RepairedMesh& mesh) {
  const SurfaceMesh& surface = mesh.built.mesh;
  const ComponentMatch& match = mesh.match;
  const auto in_trouble = [&](std::uint32_t v) {
    return !done_[mesh.component[v]];
  };
  for (const std::uint32_t v : mesh.built.copies) {
    if (in_trouble(v)) flag_point(surface.points[v], mesh.component[v]);
  }
  // The largest piece on a component is its own, the others are strays.
  std::vector<std::int64_t> size(match.pieces.size(), 0);
  for (const std::uint32_t piece : match.piece_of) size[piece] += 1;
  std::vector<std::int64_t> largest(topology_.components.size(), 0);
  for (std::size_t i = 0; i < size.size(); ++i) {
    std::int64_t& most = largest[match.pieces[i].component];
    most = std::max(most, size[i]);
  }
  for (const auto& v : surface.triangles) {
    if (!in_trouble(v[0]) && !in_trouble(v[1]) && !in_trouble(v[2])) continue;
    const Vec3& a = surface.points[v[0]];
    const Vec3& b = surface.points[v[1]];
    const Vec3& c = surface.points[v[2]];
    const Vec3 middle = (a + b + c) / 3;
    const Vec3 normal = cross(b - a, c - a);
    const Vec3 gradient = isosurface_.gradient(middle);
    const bool mixed = mesh.component[v[0]] != mesh.component[v[1]] || mesh.component[v[0]] != mesh.component[v[2]];
    const std::uint32_t piece = match.piece_of[v[0]];
    const bool stray = !match.pieces[piece].matched && size[piece] < largest[match.pieces[piece].component];
    const bool steep = -dot(normal, gradient) < kSmallCosine * norm(normal) * norm(gradient);
    if (!mixed && !stray && !steep) continue;
    flag_point(middle, mesh.component[v[0]]);
    if (!mixed && !stray) continue;
    for (const std::uint32_t q : v) flag_point(surface.points[q], mesh.component[q]);
  }
}

// Samples of unmatched components that no triangle uses.
void Repair::flag_lost_samples(const SignedDelaunay& restricted, const RepairedMesh& mesh) {
  std::vector<bool> used(restricted.delaunay().vertex_count(), false);
  for (const VertexId v : mesh.built.vertex_of) used[v.index()] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted.is_virtual(VertexId(i))) continue;
    const Vec3& p = restricted.delaunay().point(VertexId(i));
    const auto component = component_of(grid_, isosurface_.isovalue(), topology_, to_index_space(p));
    if (component && !done_[*component]) flag_point(p, *component);
  }
}

// Critical points of g that the mesh leaves on the wrong side: there a tunnel is open that should be closed, or the other way.
void Repair::flag_critical_points(const SignedDelaunay& restricted) {
  std::vector<CriticalPoint> critical;
  TetId hint = restricted.delaunay().incident_tet(VertexId(std::size_t{0}));
  std::int64_t wrong = 0;
  topology_.index.for_each_active_cell([&](const CellIndex& cell, unsigned) {
    critical.clear();
    append_critical_points(grid_.cell(cell[0], cell[1], cell[2]), critical);
    if (critical.empty()) return;
    const auto component = component_in(cell);
    if (done_[component]) return;
    for (const CriticalPoint& c : critical) {
      if (c.value == isosurface_.isovalue()) continue;
      const Vec3 p = scaled(Vec3{cell[0] + c.uvw.x, cell[1] + c.uvw.y, cell[2] + c.uvw.z}, isosurface_.step());
      hint = restricted.locate(p, hint);
      if (restricted.is_above(hint) != (c.value > isosurface_.isovalue())) {
        flag_point(p, component);
        ++wrong;
      }
    }
  });
  if (getenv("DBG")) printf("  critical wrong %ld flagged %zu\n", wrong, flagged_.size());
}

// An unmatched component without any other sign of trouble: the cells of its saddles, or all of its cells.
void Repair::flag_by_default() {
  const std::vector<bool> had_sign = component_flagged_;
  const auto is_silent = [&](std::uint32_t c) { return !done_[c] && !had_sign[c]; };
  for (const SurfaceSaddle& saddle : topology_.saddles) {
    if (is_silent(saddle.component)) flag_point(scaled(saddle.position, isosurface_.step()), saddle.component);
  }
  const std::vector<bool> had_saddle = component_flagged_;
  for (const EdgeCrossing& crossing : topology_.crossings) {
    if (!is_silent(crossing.component) || had_saddle[crossing.component]) continue;
    flag_point(scaled(crossing_position(grid_, crossing), isosurface_.step()), crossing.component);
  }
}

// Flags the cells that hold p: several when it lies on a side.
void Repair::flag_point(const Vec3& p, std::uint32_t component) {
  component_flagged_[component] = true;
  const Vec3 q = to_index_space(p);
  const CellIndex low = cell_of(q - Vec3{kOnSide, kOnSide, kOnSide});
  const CellIndex high = cell_of(q + Vec3{kOnSide, kOnSide, kOnSide});
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) flagged_.insert(name({i, j, k}));
    }
  }
}

void Repair::raise_flagged() {
  for (const std::uint64_t cell : flagged_) {
    int& level = level_[cell];
    level = std::min(level + 1, kMaxLatticeLevel);
  }
  grade();
}

// Neighbours of a finely sampled cell are at most one level coarser.
void Repair::grade() {
  std::vector<std::uint64_t> stack;
  for (const auto& [cell, level] : level_) {
    if (level >= kGradedLevel) stack.push_back(cell);
  }
  while (!stack.empty()) {
    const std::uint64_t cell = stack.back();
    stack.pop_back();
    const int least = level_[cell] - 1;
    for_each_neighbour(cell_named(cell), [&](const CellIndex& neighbour) {
      int& level = level_[name(neighbour)];
      if (level >= least) return;
      level = least;
      if (least >= kGradedLevel) stack.push_back(name(neighbour));
    });
  }
}

// Free samples inside raised cells go, lattice samples come. Free samples on the box stay: they carry its boundary
// curves.
void Repair::resample() {
  std::vector<Sample> kept;
  std::unordered_set<std::uint64_t> have;
  for (const Sample& sample : samples_) {
    const bool in_raised = level_.contains(name(cell_of(to_index_space(sample.point))));
    if (sample.key == 0 && in_raised && !SignedDelaunay::on_box(isosurface_.box(), sample.point)) continue;
    kept.push_back(sample);
    if (sample.key != 0) have.insert(sample.key);
  }
  std::vector<LatticeSample> found;
  for (const auto& [cell, level] : level_) lattice_.append(cell_named(cell), level, found);
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  for (const LatticeSample& sample : found) {
    if (have.insert(sample.key).second) kept.push_back({scaled(sample.point, isosurface_.step()), sample.key});
  }
  samples_ = std::move(kept);
}

std::unique_ptr<SignedDelaunay> Repair::rebuild() {
  std::vector<Vec3> points;
  points.reserve(samples_.size());
  for (const Sample& sample : samples_) points.push_back(sample.point);
  auto restricted = std::make_unique<SignedDelaunay>(isosurface_, points);
  take_signs_at_centroids(*restricted);
  const auto n = overturn_unfounded_signs(*restricted, grid_);
  if (getenv("DBG")) printf("  unfounded %ld\n", n);
  return restricted;
}

// In raised cells and the ring around them.
void Repair::take_signs_at_centroids(SignedDelaunay& restricted) const {
  std::unordered_set<std::uint64_t> zone;
  for (const auto& [cell, level] : level_) {
    zone.insert(cell);
    for_each_neighbour(cell_named(cell), [&](const CellIndex& neighbour) { zone.insert(name(neighbour)); });
  }
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t) || delaunay.is_ghost(t)) continue;
    const auto& v = delaunay.vertices(t);
    if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted.is_virtual(q); })) continue;
    Vec3 sum;
    double longest = 0;
    for (unsigned a = 0; a < 4; ++a) {
      sum += delaunay.point(v[a]);
      for (unsigned b = 0; b < a; ++b) {
        longest = std::max(longest, squared_distance(delaunay.point(v[a]), delaunay.point(v[b])));
      }
    }
    const Vec3 centroid = sum / 4;
    if (longest > kLongEdge * kLongEdge || !zone.contains(name(cell_of(to_index_space(centroid))))) continue;
    restricted.take_sign_at(t, centroid);
  }
}

// The exact component of some crossing on the edges of an active cell.
std::uint32_t Repair::component_in(const CellIndex& cell) const {
  for (std::int32_t edge = 0; edge < 12; ++edge) {
    const auto axis = static_cast<std::size_t>(edge / 4);
    CellIndex sample = cell;
    sample[(axis + 1) % 3] += edge & 1;
    sample[(axis + 2) % 3] += edge >> 1 & 1;
    const std::uint32_t crossing = topology_.index.find(sample[0], sample[1], sample[2], static_cast<int>(axis));
    if (crossing != CrossingIndex::kNone) return topology_.crossings[crossing].component;
  }
  return 0;
}

CellIndex Repair::cell_of(const Vec3& index_point) const {
  CellIndex cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = grid_.dims()[axis] - 2;
    cell[axis] = static_cast<std::int32_t>(std::clamp(std::floor(index_point[axis]), 0.0, last));
  }
  return cell;
}

CellIndex Repair::cell_named(std::uint64_t name) const {
  const auto nx = static_cast<std::uint64_t>(grid_.dims()[0]);
  const auto ny = static_cast<std::uint64_t>(grid_.dims()[1]);
  return {static_cast<std::int32_t>(name % nx), static_cast<std::int32_t>(name / nx % ny),
          static_cast<std::int32_t>(name / nx / ny)};
}

template <class Visit>
void Repair::for_each_neighbour(const CellIndex& cell, Visit visit) const {
  for (std::int32_t dk = -1; dk <= 1; ++dk) {
    for (std::int32_t dj = -1; dj <= 1; ++dj) {
      for (std::int32_t di = -1; di <= 1; ++di) {
        const CellIndex c{cell[0] + di, cell[1] + dj, cell[2] + dk};
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) inside &= c[axis] >= 0 && c[axis] < grid_.dims()[axis] - 1;
        if (inside && c != cell) visit(c);
      }
    }
  }
}

}  // namespace

SurfaceMesh repair(const ScalarGrid& grid, const IsosurfaceTopology& topology,
                    std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls,
                    RepairStats& stats) {
  const Isosurface& isosurface = restricted->isosurface();
  return Repair(grid, isosurface, topology, stats).run(std::move(restricted), max_rounds, controls);
}

}  // namespace deliso
