// Speed of the ray searches, on the queries that meshing makes: around points of the surface.
//
// ENGINE at 40.1 when DELISO_DATA names the directory of the public volumes, else a sum of waves of the same size.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/active_cells.h"
#include "raycast/empty_bricks.h"
#include "raycast/isosurface.h"
#include "raycast/min_max_kdtree.h"
#include "tests/support/raycast_fields.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

struct Volume {
  ScalarGrid grid;
  double isovalue;
};

const Volume& volume() {
  static const Volume kVolume = [] {
    const char* directory = std::getenv("DELISO_DATA");
    if (directory != nullptr) {
      const auto path = std::filesystem::path(directory) / "engine.nrrd";
      if (std::filesystem::exists(path)) return Volume{read_nrrd(path), 40.1};
    }
    Rng rng(1);
    return Volume{testing::wave_grid({256, 256, 256}, {1, 1, 1}, rng), 0.1};
  }();
  return kVolume;
}

SearchOptions options_of(const benchmark::State& state) {
  SearchOptions options;
  options.traversal = state.range(0) == 0 ? Traversal::kKdTree : Traversal::kCellWalk;
  return options;
}

// Points of the surface with their outward unit normals: independent of each other, or (coherent) eight at a time
// within a few voxels, like the queries of one insertion.
struct SurfacePoint {
  Vec3 point;
  Vec3 normal;
};

std::vector<SurfacePoint> surface_points(const Isosurface& surface, std::size_t count, bool coherent) {
  Rng rng(5);
  const Vec3 size = surface.box().size();
  std::vector<SurfacePoint> points;
  std::vector<Hit> hits;
  SearchCounters counters;
  const auto anywhere = [&] { return Vec3{rng.uniform(0, size.x), rng.uniform(0, size.y), rng.uniform(0, size.z)}; };
  const auto near = [&] { return rng.uniform(-2, 2); };
  Vec3 from = anywhere();
  while (points.size() < count) {
    const Vec3 direction{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    surface.all_hits({from, direction}, -1000, 1000, hits, counters);
    const Hit* nearest = nullptr;
    for (const Hit& hit : hits)
      if (nearest == nullptr || std::abs(hit.t) < std::abs(nearest->t)) nearest = &hit;
    if (nearest == nullptr) {
      from = anywhere();
      continue;
    }
    const Vec3 p = Line{from, direction}.at(nearest->t);
    const Vec3 gradient = surface.gradient(p);
    const double length = norm(gradient);
    if (length == 0) continue;
    points.push_back({p, gradient * (-1 / length)});
    const bool stay = coherent && points.size() % 8 != 0;
    if (stay) from = points[points.size() & ~std::size_t{7}].point + Vec3{near(), near(), near()};
    if (!stay) from = anywhere();
  }
  return points;
}

struct Query {
  Line line;
  double t0 = 0;
  double t1 = 0;
};

constexpr std::size_t kQueries = 1 << 14;

// Segments of 4 to 10 voxels: along the normal through the surface (hits), or moved off it by 2 to 6 voxels and turned
// along the surface (mostly misses).
std::vector<Query> segments(const Isosurface& surface, bool through, bool coherent) {
  Rng rng(6);
  std::vector<Query> queries;
  for (const SurfacePoint& s : surface_points(surface, kQueries, coherent)) {
    const double length = rng.uniform(4, 10);
    if (through) {
      queries.push_back({{s.point, s.normal}, -rng.uniform(0, length), 0});
      queries.back().t1 = queries.back().t0 + length;
    } else {
      const double side = rng.uniform(2, 6) * (rng.below(2) == 0 ? 1 : -1);
      const Vec3 random{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
      const Vec3 along = cross(s.normal, random);
      queries.push_back({{s.point + side * s.normal, along / norm(along)}, -length / 2, length / 2});
    }
  }
  return queries;
}

void run_all_hits(benchmark::State& state, bool through) {
  const Isosurface surface(volume().grid, volume().isovalue, options_of(state));
  const std::vector<Query> queries = segments(surface, through, state.range(1) != 0);
  std::vector<Hit> hits;
  SearchCounters counters;
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % kQueries];
    surface.all_hits(q.line, q.t0, q.t1, hits, counters);
    benchmark::DoNotOptimize(hits.data());
  }
  const auto searches = static_cast<double>(counters.searches);
  state.counters["hit_share"] = static_cast<double>(counters.searches_hit) / searches;
  state.counters["solves"] = static_cast<double>(counters.solves) / searches;
}

void all_hits_through(benchmark::State& state) { run_all_hits(state, true); }
void all_hits_beside(benchmark::State& state) { run_all_hits(state, false); }

// From a point 0.1 voxel beside the surface along the normal, as when a triangle's dual line starts near its triangle.
void nearest_falling_hit(benchmark::State& state) {
  const Isosurface surface(volume().grid, volume().isovalue, options_of(state));
  Rng rng(7);
  std::vector<Line> lines;
  for (const SurfacePoint& s : surface_points(surface, kQueries, state.range(1) != 0))
    lines.push_back({s.point + rng.uniform(-0.1, 0.1) * s.normal, s.normal});
  SearchCounters counters;
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(surface.nearest_falling_hit(lines[i++ % kQueries], 1e9, counters));
  state.counters["solves"] = static_cast<double>(counters.solves) / static_cast<double>(counters.searches);
}

void whole_line(benchmark::State& state) {
  const Isosurface surface(volume().grid, volume().isovalue, options_of(state));
  std::vector<Line> lines;
  for (const SurfacePoint& s : surface_points(surface, kQueries, state.range(1) != 0))
    lines.push_back({s.point, s.normal});
  std::vector<Hit> hits;
  SearchCounters counters;
  std::size_t i = 0;
  for (auto _ : state) {
    surface.all_hits(lines[i++ % kQueries], -1e9, 1e9, hits, counters);
    benchmark::DoNotOptimize(hits.data());
  }
}

void value(benchmark::State& state) {
  const Isosurface surface(volume().grid, volume().isovalue, {});
  const std::vector<SurfacePoint> points = surface_points(surface, kQueries, true);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(surface.value(points[i++ % kQueries].point));
}

void build_kd_tree(benchmark::State& state) {
  for (auto _ : state) {
    const MinMaxKdTree tree(volume().grid, static_cast<std::int32_t>(state.range(0)));
    benchmark::DoNotOptimize(tree.bytes());
    state.counters["bytes_per_sample"] =
        static_cast<double>(tree.bytes()) / static_cast<double>(volume().grid.sample_count());
  }
}

void build_active_cells(benchmark::State& state) {
  for (auto _ : state) {
    const ActiveCells active(volume().grid, volume().isovalue);
    benchmark::DoNotOptimize(active.bytes());
  }
}

void build_empty_bricks(benchmark::State& state) {
  const ActiveCells active(volume().grid, volume().isovalue);
  for (auto _ : state) {
    const EmptyBricks bricks(volume().grid, active, volume().isovalue);
    benchmark::DoNotOptimize(bricks.bytes());
  }
}

// Short segments along the surface: what a dual edge costs that has no hit.
void clear_segment(benchmark::State& state) {
  const Isosurface surface(volume().grid, volume().isovalue, {});
  const std::vector<Query> queries = segments(surface, false, true);
  std::size_t i = 0;
  std::int64_t clear = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % kQueries];
    const Vec3 a = q.line.at(q.t0);
    const Vec3 b = q.line.at(q.t1);
    clear += surface.is_clear(a, surface.place_of(a), b, surface.place_of(b)) ? 1 : 0;
  }
  state.counters["clear_share"] = static_cast<double>(clear) / static_cast<double>(state.iterations());
}

const std::vector<std::vector<std::int64_t>> kBoth = {{0, 1}, {0, 1}};
BENCHMARK(all_hits_through)->ArgNames({"walk", "coherent"})->ArgsProduct(kBoth);
BENCHMARK(all_hits_beside)->ArgNames({"walk", "coherent"})->ArgsProduct(kBoth);
BENCHMARK(nearest_falling_hit)->ArgNames({"walk", "coherent"})->ArgsProduct(kBoth);
BENCHMARK(whole_line)->ArgNames({"walk", "coherent"})->ArgsProduct(kBoth);
BENCHMARK(value);
BENCHMARK(build_kd_tree)->ArgName("leaf_cells")->Arg(1)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(build_active_cells)->Unit(benchmark::kMillisecond);
BENCHMARK(build_empty_bricks)->Unit(benchmark::kMillisecond);
BENCHMARK(clear_segment);

}  // namespace
}  // namespace deliso
