// The field, its gradient and its hits on a line, against brute force and against the signs at the line's ends.
#include "raycast/isosurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/raycast_cases.h"
#include "tests/support/raycast_fields.h"
#include "tests/support/raycast_oracle.h"
#include "volume/io/nrrd/nrrd.h"

namespace deliso {
namespace {

using testing::Case;
using testing::cases;
using testing::describe;
using testing::hits_of;
using testing::noise_grid;
using testing::random_line;
using testing::RayOracle;
using testing::wave_grid;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_alternating(const std::vector<Hit>& hits, double t0, double t1, const std::string& what) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_TRUE(hits[i].t >= t0 && hits[i].t <= t1) << what;
    if (i == 0) continue;
    ASSERT_LE(hits[i - 1].t, hits[i].t) << what;
    ASSERT_NE(hits[i - 1].falling, hits[i].falling) << what;
  }
}

TEST(Isosurface, ValueIsTheTrilinearInterpolantExtendedByTheNearestPointOfTheBox) {
  for (const Case& c : cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    const RayOracle oracle(c.grid, c.isovalue, surface.step());
    Rng rng(11);
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 p = random_line(surface, rng).origin;
      ASSERT_NEAR(surface.value(p), static_cast<double>(oracle.value({p.x, p.y, p.z})), 1e-10) << "trial " << trial;
      ASSERT_NEAR(surface.value(p), surface.value(surface.box().clamp(p)), 1e-11) << "trial " << trial;
    }
  }
}

TEST(Isosurface, GradientAgreesWithDifferencesOfValues) {
  for (const Case& c : cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    Rng rng(12);
    const Vec3 size = surface.box().size();
    for (int trial = 0; trial < 500; ++trial) {
      const Vec3 p{rng.uniform(0, size.x), rng.uniform(0, size.y), rng.uniform(0, size.z)};
      const Vec3 gradient = surface.gradient(p);
      for (std::size_t a = 0; a < 3; ++a) {
        constexpr double kStep = 1e-6;
        Vec3 before = p;
        Vec3 behind = p;
        before[a] -= kStep;
        behind[a] += kStep;
        const double plane = std::round(p[a] / surface.step()[a]) * surface.step()[a];
        if (std::abs(p[a] - plane) < 2 * kStep) continue;  // a crease
        ASSERT_NEAR(gradient[a], (surface.value(behind) - surface.value(before)) / (2 * kStep), 1e-5)
            << "trial " << trial;
      }
    }
  }
}

TEST(Isosurface, AllHitsAgreeWithBruteForceOnAllKindsOfLines) {
  for (const Case& c : cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    const RayOracle oracle(c.grid, c.isovalue, surface.step());
    Rng rng(13);
    int compared = 0;
    for (int trial = 0; trial < 1500; ++trial) {
      const Line line = random_line(surface, rng);
      const double length = std::pow(10, rng.uniform(-1, 2));
      const double t0 = rng.uniform(-length, length);
      const double t1 = rng.uniform(t0, length);
      const std::string what = describe(line, t0, t1);
      const RayOracle::Answer expected = oracle.roots(line, t0, t1);
      const std::vector<Hit> hits = hits_of(surface, line, t0, t1);
      expect_alternating(hits, t0, t1, what);
      if (expected.near_touch) continue;
      ++compared;
      ASSERT_EQ(hits.size(), expected.roots.size()) << what;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_EQ(hits[i].falling, expected.roots[i].falling) << what;
        // In voxels; ill-conditioned where the line grazes the surface.
        const double error = std::abs(hits[i].t - static_cast<double>(expected.roots[i].t)) * norm(line.direction);
        const double slope = std::abs(dot(surface.gradient(line.at(hits[i].t)), line.direction));
        ASSERT_LT(error * std::min(1.0, slope / (norm(line.direction) * 255)), 1e-10) << what;
      }
    }
    EXPECT_GT(compared, 1000);
  }
}

TEST(Isosurface, HitsLieOnTheSurfaceToOneBillionthOfAVoxel) {
  for (const Case& c : cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    Rng rng(14);
    double worst = 0;
    for (int trial = 0; trial < 5000; ++trial) {
      const Line line = random_line(surface, rng);
      for (const Hit& hit : hits_of(surface, line, -50, 50)) {
        const Vec3 p = line.at(hit.t);
        worst = std::max(worst, std::abs(surface.value(p)) / norm(surface.gradient(p)));
      }
    }
    EXPECT_LT(worst, 1e-9);
    EXPECT_GT(worst, 0);
  }
}

TEST(Isosurface, ParityEqualsTheSignsAtTheEndsWhateverTheRounding) {
  for (const Case& c : cases()) {
    for (const CubicSolver solver : {CubicSolver::kBracketed, CubicSolver::kSchwarze}) {
      SearchOptions options;
      options.solver = solver;
      const Isosurface surface(c.grid, c.isovalue, options);
      Rng rng(15);
      for (int trial = 0; trial < 4000; ++trial) {
        const Line line = random_line(surface, rng);
        // Ends anywhere, on lattice planes, on earlier hits, far away.
        const std::vector<Hit> on_line = hits_of(surface, line, -1e3, 1e3);
        const auto end = [&]() -> double {
          switch (rng.below(4)) {
            case 0:
              return static_cast<double>(rng.below(9)) - 4;
            case 1:
              return on_line.empty() ? 0 : on_line[rng.below(on_line.size())].t;
            case 2:
              return rng.uniform(-1, 1) * std::pow(10, rng.uniform(0, 15));
            default:
              return rng.uniform(-5, 5);
          }
        };
        double t0 = end();
        double t1 = end();
        if (t0 > t1) std::swap(t0, t1);
        const std::string what = describe(line, t0, t1);
        const std::vector<Hit> hits = hits_of(surface, line, t0, t1);
        expect_alternating(hits, t0, t1, what);
        const bool above0 = surface.is_above(line.at(t0));
        const bool above1 = surface.is_above(line.at(t1));
        ASSERT_EQ(hits.size() % 2 == 1, above0 != above1) << what;
        if (!hits.empty()) {
          ASSERT_EQ(hits.front().falling, above0) << what;
        }
      }
    }
  }
}

TEST(Isosurface, InfiniteLinesGiveWhatLongOnesGive) {
  for (const Case& c : cases()) {
    const Isosurface surface(c.grid, c.isovalue, {});
    Rng rng(19);
    for (int trial = 0; trial < 1000; ++trial) {
      const Line line = random_line(surface, rng);
      const std::vector<Hit> infinite = hits_of(surface, line, -kInfinity, kInfinity);
      for (const double far : {1e16, 1e100, 1e300}) {
        const std::vector<Hit> finite = hits_of(surface, line, -far, far);
        ASSERT_EQ(finite.size(), infinite.size()) << describe(line, -far, far);
        for (std::size_t i = 0; i < finite.size(); ++i) ASSERT_EQ(finite[i].t, infinite[i].t);
      }
      const std::vector<Hit> upper = hits_of(surface, line, 0, kInfinity);
      const std::vector<Hit> lower = hits_of(surface, line, -kInfinity, 0);
      ASSERT_EQ(upper.size() + lower.size(), infinite.size()) << describe(line, 0, 0);
    }
  }
}

TEST(Isosurface, LinesFromFarAwayKeepTheirDigits) {
  Rng rng(20);
  const ScalarGrid grid = wave_grid({24, 24, 24}, {1, 1, 1}, rng);
  const Isosurface surface(grid, 0.1, {});
  for (int trial = 0; trial < 1000; ++trial) {
    const Line near{{rng.uniform(0, 23), rng.uniform(0, 23), rng.uniform(0, 23)},
                    {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}};
    const double shift = std::pow(10, rng.uniform(3, 12));
    const Line far{near.at(-shift), near.direction};
    const std::vector<Hit> expected = hits_of(surface, near, -kInfinity, kInfinity);
    const std::vector<Hit> hits = hits_of(surface, far, -kInfinity, kInfinity);
    if (hits.size() != expected.size()) continue;  // the shifted line is another line, by its rounding
    for (std::size_t i = 0; i < hits.size(); ++i)
      ASSERT_NEAR(hits[i].t - shift, expected[i].t, 1e-13 * shift + 1e-9) << describe(far, 0, 0);
    for (const Hit& hit : hits)
      ASSERT_LT(std::abs(surface.value(far.at(hit.t))), 1e-14 * shift + 1e-9) << describe(far, 0, 0);
  }
}

TEST(Isosurface, AgreesWithBruteForceOnARealVolume) {
  const char* directory = std::getenv("DELISO_DATA");
  if (directory == nullptr) GTEST_SKIP() << "DELISO_DATA does not name the directory of the public volumes";
  const auto path = std::filesystem::path(directory) / "fuel.nrrd";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const ScalarGrid grid = read_nrrd(path);
  SearchOptions options;
  const Isosurface walk(grid, 70.1, options);
  options.traversal = Traversal::kKdTree;
  const Isosurface tree(grid, 70.1, options);
  const RayOracle oracle(grid, 70.1, walk.step());
  Rng rng(24);
  std::size_t found = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Line line = random_line(walk, rng);
    const RayOracle::Answer expected = oracle.roots(line, -20, 60);
    const std::vector<Hit> hits = hits_of(walk, line, -20, 60);
    const std::vector<Hit> by_tree = hits_of(tree, line, -20, 60);
    ASSERT_EQ(hits.size(), by_tree.size()) << describe(line, -20, 60);
    for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i].t, by_tree[i].t) << describe(line, -20, 60);
    if (expected.near_touch) continue;
    ASSERT_EQ(hits.size(), expected.roots.size()) << describe(line, -20, 60);
    for (std::size_t i = 0; i < hits.size(); ++i)
      ASSERT_NEAR(hits[i].t, static_cast<double>(expected.roots[i].t), 1e-9) << describe(line, -20, 60);
    found += hits.size();
  }
  EXPECT_GT(found, 200u);
}

TEST(Isosurface, DegenerateQueriesHaveNoHits) {
  Rng rng(21);
  const ScalarGrid grid = noise_grid({5, 5, 5}, {1, 1, 1}, rng);
  const Isosurface surface(grid, 127.5, {});
  const Line line{{1.5, 2.5, 0.5}, {1, 0.3, 0.2}};
  EXPECT_TRUE(hits_of(surface, line, 1, 1).empty());
  EXPECT_TRUE(hits_of(surface, line, 2, 1).empty());
  EXPECT_TRUE(hits_of(surface, line, kInfinity, kInfinity).empty());
  EXPECT_TRUE(hits_of(surface, {{1.5, 2.5, 0.5}, {0, 0, 0}}, -kInfinity, kInfinity).empty());
  EXPECT_TRUE(hits_of(surface, {{1.5, 2.5, 0.5}, {0, 0, 0}}, -5, 5).empty());
  SearchCounters counters;
  EXPECT_FALSE(surface.nearest_falling_hit({{1.5, 2.5, 0.5}, {0, 0, 0}}, kInfinity, counters).has_value());
  // Denormal and enormous directions end, with finite answers.
  for (const double scale : {1e-310, 1e-200, 1e200, 1e300})
    for (const Hit& hit : hits_of(surface, {{1.5, 2.5, 0.5}, {scale, 0.5 * scale, 0}}, -kInfinity, kInfinity))
      EXPECT_TRUE(std::isfinite(hit.t));
}

}  // namespace
}  // namespace deliso
