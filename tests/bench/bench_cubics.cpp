// Speed of the cubic solvers, by the number of sign changes within the cell, and of a whole cell.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/cubic_solver.h"
#include "raycast/voxel_intersection.h"

namespace deliso {
namespace {

constexpr std::size_t kCases = 1 << 12;

// Random cubics with so many sign changes.
std::vector<BernsteinCubic> cubics_with(int changes) {
  Rng rng(1);
  std::vector<BernsteinCubic> cubics;
  while (cubics.size() < kCases) {
    BernsteinCubic cubic;
    for (double& b : cubic) b = rng.uniform(-1, 1);
    if (changes == 3) cubic = {cubic[0], -4 * cubic[0], -4 * cubic[3], cubic[3]};
    if (bracketed_sign_changes(cubic).count == changes) cubics.push_back(cubic);
  }
  return cubics;
}

template <class Solver>
void solve(benchmark::State& state, Solver solver) {
  const std::vector<BernsteinCubic> cubics = cubics_with(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solver(cubics[i++ % kCases]));
}

void bracketed(benchmark::State& state) { solve(state, bracketed_sign_changes); }
void schwarze(benchmark::State& state) { solve(state, schwarze_sign_changes); }

// A ray through a cell of random samples: the cubic along it and its sign changes.
void whole_cell(benchmark::State& state) {
  struct Case {
    CellCorners corners;
    Vec3 in;
    Vec3 out;
  };
  Rng rng(2);
  std::vector<Case> cases(kCases);
  for (Case& c : cases) {
    for (double& corner : c.corners) corner = rng.uniform(-1, 1);
    c.in = {0, rng.uniform(), rng.uniform()};
    c.out = {1, rng.uniform(), rng.uniform()};
  }
  const CubicSolver solver = state.range(0) == 0 ? CubicSolver::kBracketed : CubicSolver::kSchwarze;
  std::size_t i = 0;
  for (auto _ : state) {
    const Case& c = cases[i++ % kCases];
    bool starts_above = false;
    benchmark::DoNotOptimize(voxel_intersection(c.corners, c.in, c.out, solver, starts_above));
  }
}

BENCHMARK(bracketed)->ArgName("changes")->DenseRange(0, 3);
BENCHMARK(schwarze)->ArgName("changes")->DenseRange(0, 3);
BENCHMARK(whole_cell)->ArgName("schwarze")->Arg(0)->Arg(1);

}  // namespace
}  // namespace deliso
