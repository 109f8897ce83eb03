#include "surface/certificate/graded_cubes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "surface/mesh/side_adjacency.h"
#include "volume/filters/finer_grid.h"

namespace deliso {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // directed, by vertices of the whole mesh
using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = CrossingIndex::kNone;

class GradedCubes {
 public:
  GradedCubes(const ExactSurface& surface, const GridFactors& factors, ExactPolygonization coarse)
      : surface_(surface), factors_(factors), all_(std::move(coarse)) {}

  // Appends the cubes of a cell: false where its edges have other crossings there.
  bool add(const CellIndex& cell);
  // The mesh, with fans at the faces of the cells.
  ExactPolygonization joined() &&;

 private:
  struct CellCubes {
    IsosurfaceTopology topology;
    ExactPolygonization cubes;
  };
  // The edge of the finer grid from a sample, along an axis.
  using FineEdge = std::array<std::int32_t, 4>;

  [[nodiscard]] std::optional<CellCubes> cubes_of(const CellIndex& cell) const;
  bool number_crossings(const CellIndex& cell, const CellCubes& its, std::vector<std::uint32_t>& number);
  std::uint32_t new_vertex(const CellIndex& cell, const Vec3& place, std::uint32_t component);
  void keep_chains(const std::vector<Triangle>& triangles);
  void append_fans(const Triangle& triangle, std::vector<Triangle>& fans) const;
  [[nodiscard]] bool is_crossing_of_grid(std::uint32_t v) const { return v < surface_.topology.crossings.size(); }

  const ExactSurface& surface_;
  const GridFactors factors_;
  ExactPolygonization all_;
  std::vector<Triangle> finer_;                 // of the cells
  std::map<FineEdge, std::uint32_t> on_faces_;  // the vertices on faces, but not on edges, of the cells
  // What lies between the ends of an edge of the cell across a face.
  std::map<Edge, std::vector<std::uint32_t>> chains_;
};

std::optional<GradedCubes::CellCubes> GradedCubes::cubes_of(const CellIndex& cell) const {
  const double isovalue = surface_.isosurface.isovalue();
  const std::int64_t count = std::int64_t{factors_[0] + 1} * (factors_[1] + 1) * (factors_[2] + 1);
  const std::optional<ScalarGrid> grid = finer_grid(surface_.grid(), {cell, {2, 2, 2}}, factors_, count);
  const auto& samples = std::get<SampleArray<double>>(grid->samples());
  if (std::find(samples.begin(), samples.end(), isovalue) != samples.end()) return std::nullopt;
  CellCubes its{exact_topology(*grid, isovalue), {}};
  keep_apart(its.topology);
  const Isosurface isosurface(*grid, isovalue, SearchOptions{});
  its.cubes = exact_polygonization({isosurface, its.topology, 1});
  return its;
}

std::uint32_t GradedCubes::new_vertex(const CellIndex& cell, const Vec3& place, std::uint32_t component) {
  const Vec3& step = surface_.isosurface.step();
  Vec3 point;
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = (cell[axis] + place[axis] / factors_[axis]) * step[axis];
  all_.mesh.points.push_back(point);
  all_.component.push_back(component);
  return static_cast<std::uint32_t>(all_.mesh.points.size() - 1);
}

// Those on edges of the cell are the grid's own, those on faces may be of a cell before. False where the edges have
// others than the grid's, or a component has none there.
bool GradedCubes::number_crossings(const CellIndex& cell, const CellCubes& its, std::vector<std::uint32_t>& number) {
  std::set<std::uint32_t> expected;
  surface_.topology.index.for_each_crossing_of_cell(cell, [&](std::uint32_t crossing) { expected.insert(crossing); });
  const Dims dims{factors_[0] + 1, factors_[1] + 1, factors_[2] + 1};
  std::vector<std::uint32_t> component(its.topology.components.size(), kNone);
  std::vector<FineEdge> edges;
  std::vector<int> sides;  // of the cell: how many of its faces an edge lies on
  for (const EdgeCrossing& crossing : its.topology.crossings) {
    const CellIndex at = sample_of(crossing, dims);
    FineEdge edge{0, 0, 0, crossing.axis};
    int on_faces = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      edge[axis] = cell[axis] * factors_[axis] + at[axis];
      if (axis != crossing.axis && at[axis] % factors_[axis] == 0) ++on_faces;
    }
    edges.push_back(edge);
    sides.push_back(on_faces);
    if (on_faces < 2) continue;
    CellIndex low = cell;
    for (std::size_t axis = 0; axis < 3; ++axis) low[axis] += at[axis] / factors_[axis];
    const std::uint32_t own = surface_.topology.index.find(low[0], low[1], low[2], crossing.axis);
    if (expected.erase(own) == 0) return false;
    number[edges.size() - 1] = own;
    component[crossing.component] = surface_.topology.crossings[own].component;
  }
  if (!expected.empty()) return false;
  if (std::find(component.begin(), component.end(), kNone) != component.end()) return false;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] != kNone) continue;
    const bool is_on_face = v < sides.size() && sides[v] == 1;
    if (const auto known = is_on_face ? on_faces_.find(edges[v]) : on_faces_.end(); known != on_faces_.end()) {
      number[v] = known->second;
      continue;
    }
    number[v] = new_vertex(cell, its.cubes.mesh.points[v], component[its.cubes.component[v]]);
    if (is_on_face) on_faces_.emplace(edges[v], number[v]);
  }
  return true;
}

bool GradedCubes::add(const CellIndex& cell) {
  bool is_crossed = false;
  surface_.topology.index.for_each_crossing_of_cell(cell, [&](std::uint32_t) { is_crossed = true; });
  if (!is_crossed) return true;
  const std::optional<CellCubes> its = cubes_of(cell);
  if (!its) return false;
  std::vector<std::uint32_t> number(its->cubes.mesh.points.size(), kNone);
  if (!number_crossings(cell, *its, number)) return false;
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : its->cubes.mesh.triangles) triangles.push_back({number[a], number[b], number[c]});
  keep_chains(triangles);
  finer_.insert(finer_.end(), triangles.begin(), triangles.end());
  return true;
}

// From crossing to crossing of the grid along the faces of the cell.
void GradedCubes::keep_chains(const std::vector<Triangle>& triangles) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : triangles) edges.insert({Edge{a, b}, Edge{b, c}, Edge{c, a}});
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) next[a] = b;
  }
  for (const auto& [first, second] : next) {
    if (!is_crossing_of_grid(first)) continue;
    std::vector<std::uint32_t> between;
    std::uint32_t last = second;
    for (; !is_crossing_of_grid(last) && between.size() < next.size(); last = next.at(last)) between.push_back(last);
    std::reverse(between.begin(), between.end());
    chains_[{last, first}] = std::move(between);
  }
}

void GradedCubes::append_fans(const Triangle& triangle, std::vector<Triangle>& fans) const {
  std::vector<Triangle> open{triangle};
  while (!open.empty()) {
    const Triangle t = open.back();
    open.pop_back();
    bool is_whole = true;
    for (std::size_t i = 0; i < 3 && is_whole; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3], apex = t[(i + 2) % 3];
      const auto chain = chains_.find({a, b});
      if (chain == chains_.end() || chain->second.empty()) continue;
      is_whole = false;
      std::uint32_t from = a;
      for (const std::uint32_t to : chain->second) open.push_back({std::exchange(from, to), to, apex});
      open.push_back({from, b, apex});
    }
    if (is_whole) fans.push_back(t);
  }
}

ExactPolygonization GradedCubes::joined() && {
  std::vector<Triangle> triangles;
  for (const Triangle& t : all_.mesh.triangles) append_fans(t, triangles);
  triangles.insert(triangles.end(), finer_.begin(), finer_.end());
  all_.mesh.triangles = std::move(triangles);
  all_.mesh.pole_heights.assign(all_.mesh.points.size(), 1);
  set_side_adjacency(all_.mesh);
  take_strips_off(all_, surface_.isosurface);
  return std::move(all_);
}

}  // namespace

std::optional<ExactPolygonization> graded_cubes(const ExactSurface& surface, const std::vector<CellIndex>& cells,
                                                const GridFactors& factors) {
  const std::set<CellIndex> divided(cells.begin(), cells.end());
  GradedCubes graded(surface, factors,
                     cubes_without(surface, [&](const CellIndex& cell) { return divided.contains(cell); }));
  for (const CellIndex& cell : divided) {
    if (!graded.add(cell)) return std::nullopt;
  }
  return std::move(graded).joined();
}

}  // namespace deliso
