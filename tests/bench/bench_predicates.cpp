// Speed of the exact predicates by case, and of building Delaunay triangulations of up to 100,000 points.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/constructions.h"
#include "delaunay/predicates.h"
#include "tests/support/delaunay_point_sets.h"

namespace deliso {
namespace {

constexpr std::size_t kCases = 1 << 12;

using Five = std::array<Vec3, 5>;

Vec3 random_point(Rng& rng) { return {rng.uniform(), rng.uniform(), rng.uniform()}; }

// Turns the first four points into a positive tetrahedron.
void orient(Five& five) {
  if (orient3d(five[0], five[1], five[2], five[3]) < 0) std::swap(five[0], five[1]);
}

std::vector<Five> random_cases() {
  Rng rng(1);
  std::vector<Five> cases(kCases);
  for (Five& five : cases) {
    for (Vec3& p : five) p = random_point(rng);
    orient(five);
  }
  return cases;
}

// Points of one plane: exactly, on a lattice, or (rounded) an oblique one.
std::vector<Five> coplanar_cases(bool exactly) {
  Rng rng(2);
  std::vector<Five> cases(kCases);
  for (Five& five : cases) {
    const double height = static_cast<double>(rng.below(256));
    for (Vec3& p : five) {
      const Vec3 on_lattice{static_cast<double>(rng.below(256)), static_cast<double>(rng.below(256)), height};
      const Vec3 anywhere = random_point(rng);
      p = exactly ? on_lattice : Vec3{anywhere.x, anywhere.y, 0.3 * anywhere.x + 0.7 * anywhere.y};
    }
  }
  return cases;
}

// Points of one sphere: exactly, on a lattice, or rounded.
std::vector<Five> cospherical_cases(bool exactly) {
  Rng rng(3);
  const test::Points sphere = exactly ? test::cospherical(rng) : test::rounded_sphere(1000, rng);
  std::vector<Five> cases;
  while (cases.size() < kCases) {
    Five five;
    for (Vec3& p : five) p = sphere[rng.below(sphere.size())];
    if (orient3d(five[0], five[1], five[2], five[3]) == 0) continue;
    orient(five);
    cases.push_back(five);
  }
  return cases;
}

template <class Predicate>
void over(benchmark::State& state, const std::vector<Five>& cases, Predicate predicate) {
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(predicate(cases[i++ % kCases]));
}

double orient_four(const Five& f) { return orient3d(f[0], f[1], f[2], f[3]); }
double insphere_five(const Five& f) { return insphere(f[0], f[1], f[2], f[3], f[4]); }

void orient3d_random(benchmark::State& state) { over(state, random_cases(), orient_four); }
void orient3d_coplanar(benchmark::State& state) { over(state, coplanar_cases(true), orient_four); }
void orient3d_nearly_coplanar(benchmark::State& state) { over(state, coplanar_cases(false), orient_four); }
void insphere_random(benchmark::State& state) { over(state, random_cases(), insphere_five); }
void insphere_cospherical(benchmark::State& state) { over(state, cospherical_cases(true), insphere_five); }
void insphere_nearly_cospherical(benchmark::State& state) { over(state, cospherical_cases(false), insphere_five); }
void circumcenter_random(benchmark::State& state) {
  over(state, random_cases(), [](const Five& f) { return circumcenter(f[0], f[1], f[2], f[3]); });
}

// A wavy sheet, the kind of set that the mesher inserts.
test::Points sheet(std::size_t count, Rng& rng) {
  test::Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = random_point(rng);
    points.push_back({p.x, p.y, 0.5 + 0.1 * std::sin(9 * p.x) * std::cos(7 * p.y)});
  }
  return points;
}

template <class Points>
void build(benchmark::State& state, Points points_of) {
  Rng rng(4);
  const test::Points points = points_of(static_cast<std::size_t>(state.range(0)), rng);
  const Box3 box = test::box_of(points);
  for (auto _ : state) {
    BowyerWatson triangulation(box);
    benchmark::DoNotOptimize(triangulation.build(points));
  }
  state.counters["points_per_second"] =
      benchmark::Counter(static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void build_cube(benchmark::State& state) { build(state, test::random_points); }
void build_sheet(benchmark::State& state) { build(state, sheet); }
void build_rounded_sphere(benchmark::State& state) { build(state, test::rounded_sphere); }

BENCHMARK(orient3d_random);
BENCHMARK(orient3d_coplanar);
BENCHMARK(orient3d_nearly_coplanar);
BENCHMARK(insphere_random);
BENCHMARK(insphere_cospherical);
BENCHMARK(insphere_nearly_cospherical);
BENCHMARK(circumcenter_random);
BENCHMARK(build_cube)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(build_sheet)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(build_rounded_sphere)->Arg(1000)->Arg(20000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deliso
