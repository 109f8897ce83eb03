#include "experiments/lesson/lesson_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "raycast/intersect.h"
#include "raycast/isosurface.h"
#include "raycast/voxel_intersection.h"

namespace deliso {
namespace {

constexpr int kTries = 40, kKept = 5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Json numbers_of(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

// A line through two random points of the box.
Line random_line(const Box3& box, Rng& rng) {
  const auto random = [&] {
    const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
    return box.low + scaled({x, y, z}, box.high - box.low);
  };
  const Vec3 from = random(), way = random() - from;
  return {from, way / std::max(norm(way), 1e-300)};
}

// The node as cells of the grid; a node goes on outward at the faces of the box.
Json node_json(const NodeVisit& node, const Dims& dims) {
  Json json = {{"level", node.level}, {"pruned", node.is_pruned}};
  json["low"] = grid_cell(node.block.low, dims);
  json["high"] = grid_cell(node.block.high, dims);
  return json;
}

// The field along the line within a cell as a cubic in Bernstein form.
BernsteinCubic cubic_in(const ScalarGrid& grid, double isovalue, const LineSegment& r, const CellVisit& visit) {
  const Cell base = grid_cell(visit.cell, grid.dims());
  const auto at = [&](double s) {
    Vec3 p;
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] = std::clamp(r.line.base[a] + s * r.line.direction[a] - static_cast<double>(base[a]), 0.0, 1.0);
    }
    return p;
  };
  return restrict_to_segment(relative_to(grid.cell(base[0], base[1], base[2]), isovalue), at(visit.in.s),
                             at(visit.out.s));
}

Json ray_json(const Isosurface& isosurface, const MinMaxKdTree& tree, const Line& line) {
  const ScalarGrid& grid = isosurface.grid();
  const double isovalue = isosurface.isovalue();
  const Vec3 &step = isosurface.step(), inverse{1 / step.x, 1 / step.y, 1 / step.z};
  const LineSegment r(line, -kInfinity, kInfinity, inverse, grid.dims());
  std::vector<NodeVisit> nodes;
  const std::vector<CellVisit> voxels = collect_voxels(grid, tree, isovalue, r, &nodes);
  Json json = {{"origin", numbers_of(line.origin)}, {"direction", numbers_of(line.direction)}};
  json["nodes"] = Json::array();
  json["cells"] = Json::array();
  json["hits"] = Json::array();
  for (const NodeVisit& node : nodes) json["nodes"].push_back(node_json(node, grid.dims()));
  std::vector<Hit> hits, slow;
  for (const CellVisit& voxel : voxels) {
    const CellHits found = solve_cell(grid, isovalue, CubicSolver::kBracketed, r.line, voxel, r.low, r.high);
    Json roots = Json::array();
    for (int i = 0; i < found.changes.count; ++i) roots.push_back(found.changes.at[static_cast<std::size_t>(i)]);
    find_intersections_in(voxel, grid, isovalue, CubicSolver::kBracketed, r, slow);
    json["cells"].push_back({{"cell", grid_cell(voxel.cell, grid.dims())},
                             {"in", r.line.t_origin + voxel.in.s},
                             {"out", r.line.t_origin + voxel.out.s},
                             {"cubic", cubic_in(grid, isovalue, r, voxel)},
                             {"roots", roots}});
  }
  const auto is_same = [](const Hit& a, const Hit& b) { return a.t == b.t && a.falling == b.falling; };
  SearchCounters counters;
  isosurface.all_hits(line, -kInfinity, kInfinity, hits, counters);
  DELISO_CHECK(
      std::equal(hits.begin(), hits.end(), slow.begin(), slow.end(), is_same) && counters.solves == voxels.size(),
      "the slow search is that of the program");
  for (const Hit& hit : hits) json["hits"].push_back(hit.t);
  return json;
}

}  // namespace

Json lesson_rays(const ScalarGrid& grid, double isovalue, const Vec3& spacing, std::uint64_t seed) {
  SearchOptions options;
  options.traversal = Traversal::kKdTree;
  const Isosurface isosurface(grid, isovalue, options, spacing);
  const MinMaxKdTree tree(grid, options.leaf_cells);
  Rng rng(seed);
  std::vector<Json> rays;
  rays.reserve(kTries);
  for (int i = 0; i < kTries; ++i) rays.push_back(ray_json(isosurface, tree, random_line(isosurface.box(), rng)));
  std::stable_sort(rays.begin(), rays.end(),
                   [](const Json& a, const Json& b) { return a["hits"].size() > b["hits"].size(); });
  rays.resize(kKept);
  return rays;
}

}  // namespace deliso
