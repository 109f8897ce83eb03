#include "surface/repair/diagnosis/euler_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;

EulerCurves swept(const SurfaceMesh& mesh, const std::array<std::int32_t, 3>& dims) {
  return euler_curves(mesh, std::vector<std::uint32_t>(mesh.points.size(), 0), 1, {1, 1, 1}, dims).front();
}

TEST(EulerCurve, EqualMeshesNeverDiffer) {
  const auto scene = field_scene("gyroid", 24);
  const SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  for (const auto& layers : jumps_between(swept(mesh, scene->grid.dims()), swept(mesh, scene->grid.dims()))) {
    EXPECT_TRUE(layers.empty());
  }
}

// A hole in the mesh changes its Euler characteristic by one from its layers on: the curves must show where.
TEST(EulerCurve, FindsWhereAHoleIsPunched) {
  const auto scene = field_scene("gyroid", 32);
  const SurfaceMesh exact = exact_polygonization(scene->surface()).mesh;
  // The same surface with a patch of a few triangles punched out: the Euler characteristic falls by one there.
  SurfaceMesh punched = exact;
  const Vec3 place = exact.points[exact.triangles[exact.triangles.size() / 2][0]];
  std::vector<bool> gone(punched.triangles.size());
  std::uint32_t kept = 0;
  std::vector<std::uint32_t> renamed(punched.triangles.size(), kNoSide);
  for (std::uint32_t t = 0; t < punched.triangles.size(); ++t) {
    gone[t] = distance(punched.points[punched.triangles[t][0]], place) == 0;
    if (!gone[t]) renamed[t] = kept++;
  }
  ASSERT_LT(kept, punched.triangles.size());
  SurfaceMesh left;
  left.points = punched.points;
  for (std::uint32_t t = 0; t < punched.triangles.size(); ++t) {
    if (gone[t]) continue;
    left.triangles.push_back(punched.triangles[t]);
    left.neighbours.push_back(punched.neighbours[t]);
    for (TriangleSide& side : left.neighbours.back()) {
      if (side != kNoSide) side = renamed[side >> 2] == kNoSide ? kNoSide : 4 * renamed[side >> 2] + (side & 3u);
    }
  }
  const auto jumps = jumps_between(swept(left, scene->grid.dims()), swept(exact, scene->grid.dims()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(jumps[axis].size(), 1u) << "axis " << axis;
    EXPECT_NEAR(jumps[axis][0], place[axis], 3) << "axis " << axis;
  }
}

TEST(EulerCurve, PartsInOnePassAreLikePartsAlone) {
  const auto scene = field_scene("bubbles", 26);
  const ExactPolygonization surface = exact_polygonization(scene->surface());
  const std::size_t parts = scene->topology.components.size();
  ASSERT_GT(parts, 1u);
  const auto all = euler_curves(surface.mesh, surface.component, parts, {1, 1, 1}, scene->grid.dims());
  for (std::uint32_t c = 0; c < parts; ++c) {
    std::vector<std::uint32_t> alone(surface.component.size(), kNoPart);
    for (std::size_t v = 0; v < alone.size(); ++v) alone[v] = surface.component[v] == c ? 0 : kNoPart;
    EXPECT_EQ(euler_curves(surface.mesh, alone, 1, {1, 1, 1}, scene->grid.dims()).front(), all[c]);
    for (const auto& along : all[c]) EXPECT_EQ(along.back(), scene->topology.components[c].euler_characteristic);
  }
}

// A piecewise constant function that fits a gap of two curves: its level at each layer, and what it costs. As in
// lasting_jumps(): a jump by one costs as much as a deviation over six layers, and levels lie within one of those of
// the start and the end.
struct Fit {
  std::int64_t cost = 0;
  std::vector<std::int64_t> levels;
};
constexpr std::int64_t kJump = 6;
constexpr std::int64_t kBeyond = 1;

std::int64_t cost_of(const std::vector<std::int64_t>& gap, const std::vector<std::int64_t>& levels) {
  std::int64_t cost = 0, before = 0;
  for (std::size_t i = 0; i < gap.size(); ++i) {
    cost += kJump * std::abs(levels[i] - before) + std::abs(gap[i] - levels[i]);
    before = levels[i];
  }
  return cost;
}

// Layer by layer, over all pairs of a level and the one before it; of equal ones the lowest.
Fit best_fit_over_all_pairs(const std::vector<std::int64_t>& gap) {
  const std::int64_t low = std::min<std::int64_t>(0, gap.back()) - kBeyond;
  const std::int64_t high = std::max<std::int64_t>(0, gap.back()) + kBeyond;
  std::vector<Fit> fits;  // that end at each level
  for (std::size_t i = 0; i < gap.size(); ++i) {
    std::vector<Fit> next;
    for (std::int64_t to = low; to <= high; ++to) {
      std::optional<Fit> best;
      for (std::int64_t from = low; from <= high; ++from) {
        if (i == 0 && from != 0) continue;
        Fit fit = i == 0 ? Fit{} : fits[static_cast<std::size_t>(from - low)];
        fit.cost += kJump * std::abs(to - from) + std::abs(gap[i] - to);
        fit.levels.push_back(to);
        if (!best || fit.cost < best->cost) best = std::move(fit);
      }
      next.push_back(std::move(*best));
    }
    fits = std::move(next);
  }
  return fits[static_cast<std::size_t>(gap.back() - low)];
}

// The least cost of all functions there are.
std::int64_t least_cost_of_all(const std::vector<std::int64_t>& gap) {
  const std::int64_t low = std::min<std::int64_t>(0, gap.back()) - kBeyond;
  const std::int64_t high = std::max<std::int64_t>(0, gap.back()) + kBeyond;
  std::vector<std::int64_t> levels(gap.size(), low);
  levels.back() = gap.back();
  std::int64_t least = cost_of(gap, levels);
  for (std::size_t at = 0; at + 1 < levels.size();) {  // count up, the first layer fastest
    if (levels[at] == high) {
      levels[at++] = low;
      continue;
    }
    ++levels[at];
    least = std::min(least, cost_of(gap, levels));
    at = 0;
  }
  return least;
}

// Short pieces that stay at a level for some layers, with deviations of one or two here and there.
std::vector<std::int64_t> random_gap(std::size_t layers, Rng& rng) {
  std::vector<std::int64_t> gap;
  std::int64_t level = 0;
  for (std::size_t i = 0; i < layers; ++i) {
    if (rng.below(8) == 0) level += static_cast<std::int64_t>(rng.below(7)) - 3;
    const bool deviates = rng.below(4) == 0;
    gap.push_back(level + (deviates ? static_cast<std::int64_t>(rng.below(5)) - 2 : 0));
  }
  return gap;
}

TEST(EulerCurve, TwoPassesOverTheLevelsFindTheBestOfAllPairs) {
  std::size_t jumped = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Rng rng(seed);
    EulerCurves mesh, exact;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh[axis] = random_gap(1 + rng.below(40), rng);
      for (std::int64_t& value : mesh[axis]) {
        exact[axis].push_back(static_cast<std::int64_t>(rng.below(9)) - 4);
        value += exact[axis].back();
      }
    }
    const auto jumps = jumps_between(mesh, exact);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::int64_t> gap = mesh[axis];
      for (std::size_t i = 0; i < gap.size(); ++i) gap[i] -= exact[axis][i];
      const Fit best = best_fit_over_all_pairs(gap);
      ASSERT_EQ(best.cost, cost_of(gap, best.levels));
      std::vector<std::int32_t> expected;
      for (std::size_t i = 0; i < gap.size(); ++i) {
        if (best.levels[i] != (i == 0 ? 0 : best.levels[i - 1])) expected.push_back(static_cast<std::int32_t>(i));
      }
      ASSERT_EQ(jumps[axis], expected) << "seed " << seed << ", axis " << axis;
      jumped += expected.size();
    }
  }
  EXPECT_GT(jumped, 2000u);
}

TEST(EulerCurve, NoFunctionFitsBetterThanTheBestOfAllPairs) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const std::vector<std::int64_t> gap = random_gap(1 + rng.below(6), rng);
    ASSERT_EQ(best_fit_over_all_pairs(gap).cost, least_cost_of_all(gap)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace deliso
