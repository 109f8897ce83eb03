// bench_stages RUNS [NAME SIZE | VOLUME ISOVALUE] [observed]: times the stages of a run without certificate and repair,
// on a built-in volume of SIZE^3 samples at its own isovalue or on a file. Without a volume: gyroid and blobs, 128^3.
// Prints one line per volume: medians over the runs, microseconds per insertion, and a hash of the mesh after each
// stage, which tells whether two versions of the program compute the same. `observed`: under an observer that does
// nothing.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/base/observer.h"
#include "surface/extract/build_triangle_mesh.h"
#include "surface/recover/boundary_curves.h"
#include "surface/recover/component_seeds.h"
#include "surface/recover/recover.h"
#include "surface/refine/refine.h"
#include "surface/restricted/poles.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"
#include "volume/topology/exact_topology.h"

namespace {

using namespace deliso;

// FNV-1a over 64-bit words.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3ull; }
  void add(const Vec3& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis]));
  }
  void add(const SurfaceMesh& mesh) {
    for (const Vec3& p : mesh.points) add(p);
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) add(v);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ull;
};

struct Run {
  double topology = 0;  // seconds
  double index = 0;
  double initial = 0;
  double stage1 = 0;
  double build = 0;
  double stage2 = 0;
  RecoverStats recover;
  RefineStats refine;
  std::size_t vertices = 0;
  std::uint64_t hash1 = 0;
  std::uint64_t hash2 = 0;
};

// Processor time since the last lap, in seconds: other load on the machine counts less than on the clock.
class Laps {
 public:
  double lap() {
    const std::clock_t now = std::clock();
    const auto ticks = static_cast<double>(now - last_);
    last_ = now;
    return ticks / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t last_ = std::clock();
};

Run run_once(const ScalarGrid& grid, double given_isovalue, Observer* observer) {
  Run run;
  Laps laps;
  const RegularTopology regular = regular_topology(grid, given_isovalue);
  run.topology = laps.lap();
  const Isosurface isosurface(grid, regular.isovalue, {});
  run.index = laps.lap();
  std::vector<Vec3> points = boundary_curve_points(isosurface);
  const std::vector<Vec3> seeds = component_seeds({isosurface, regular.topology});
  points.insert(points.end(), seeds.begin(), seeds.end());
  auto restricted = std::make_unique<RestrictedDelaunay>(isosurface, points);
  restricted->set_observer(observer);
  run.initial = laps.lap();

  const double r_min = 0.001 * isosurface.box().smallest_side();
  RecoverOptions stage1;
  stage1.geometry.r_min = r_min;
  stage1.size_bound = std::max(r_min, 0.3);
  Controls controls({}, nullptr, {});
  laps.lap();
  recover(*restricted, stage1, controls, run.recover);
  run.stage1 = laps.lap();

  const std::vector<double> heights = compute_poles(*restricted);
  BuiltMesh built = build_triangle_mesh(*restricted);
  SurfaceMesh& mesh = built.mesh;
  for (const VertexId v : built.vertex_of) mesh.pole_heights.push_back(heights[v.index()]);
  run.build = laps.lap();
  Hash hash1;
  hash1.add(mesh);
  run.hash1 = hash1.value();
  RefineOptions stage2;
  stage2.r_min = r_min;
  stage2.observer = observer;
  laps.lap();
  refine_geometry(mesh, isosurface, stage2, controls, run.refine);
  run.stage2 = laps.lap();
  Hash hash2;
  hash2.add(mesh);
  run.hash2 = hash2.value();
  run.vertices = mesh.points.size();
  return run;
}

double median(const std::vector<Run>& runs, double Run::*seconds) {
  std::vector<double> all;
  for (const Run& run : runs) all.push_back(run.*seconds);
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

void bench(const std::string& name, const ScalarGrid& grid, double isovalue, int count, Observer* observer) {
  std::vector<Run> runs;
  for (int i = 0; i < count; ++i) runs.push_back(run_once(grid, isovalue, observer));
  const Run& one = runs.front();
  const double stage1 = median(runs, &Run::stage1);
  const double stage2 = median(runs, &Run::stage2);
  const auto insertions1 = static_cast<double>(one.recover.insertions);
  const auto insertions2 = static_cast<double>(one.refine.insertions);
  std::cout << "volume=" << name << " topology=" << median(runs, &Run::topology)
            << " index=" << median(runs, &Run::index) << " initial=" << median(runs, &Run::initial)
            << " stage1=" << stage1 << " insertions1=" << one.recover.insertions
            << " us_per_insertion1=" << 1e6 * stage1 / insertions1 << " build=" << median(runs, &Run::build)
            << " stage2=" << stage2 << " insertions2=" << one.refine.insertions
            << " us_per_insertion2=" << 1e6 * stage2 / insertions2 << " vertices=" << one.vertices << std::hex
            << " hash1=" << one.hash1 << " hash2=" << one.hash2 << std::dec << std::endl;
}

void bench_built_in(const std::string& name, int size, int count, Observer* observer) {
  bench(name + ":" + std::to_string(size), generate_field(name, size), find_analytic_field(name).isovalue, count,
        observer);
}

bool is_built_in(const std::string& name) {
  const auto& fields = analytic_fields();
  return std::any_of(fields.begin(), fields.end(), [&](const AnalyticField& field) { return field.name == name; });
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_observed = argc > 2 && std::string(argv[argc - 1]) == "observed";
  if (is_observed) --argc;
  Observer idle;
  Observer* const observer = is_observed ? &idle : nullptr;
  const int count = argc > 1 ? std::atoi(argv[1]) : 0;
  if ((argc != 2 && argc != 4) || count < 1) {
    std::cerr << "usage: bench_stages RUNS [NAME SIZE | VOLUME ISOVALUE] [observed]\n";
    return 2;
  }
  try {
    if (argc == 2) {
      bench_built_in("gyroid", 128, count, observer);
      bench_built_in("blobs", 128, count, observer);
    } else if (is_built_in(argv[2])) {
      bench_built_in(argv[2], std::atoi(argv[3]), count, observer);
    } else {
      bench(std::filesystem::path(argv[2]).filename().string(), read_volume(argv[2]), std::atof(argv[3]), count,
            observer);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
