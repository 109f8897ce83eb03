#include "surface/repair/signs/spurious_pockets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/base/parallel_blocks.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::dense;
using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// Whether barycentric coordinates in long doubles are all at least -slack.
bool holds(const std::array<Vec3, 4>& tet, const Vec3& p, double slack) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(cross(b - a, c - a), d - a);
  };
  const double whole = volume(tet[0], tet[1], tet[2], tet[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vec3, 4> replaced = tet;
    replaced[i] = p;
    if (volume(replaced[0], replaced[1], replaced[2], replaced[3]) < -slack * whole) return false;
  }
  return true;
}

bool holds_any_sample(const Scene& scene, const std::array<Vec3, 4>& tet, double slack) {
  for (std::int32_t k = 0; k < scene.grid.dims()[2]; ++k) {
    for (std::int32_t j = 0; j < scene.grid.dims()[1]; ++j) {
      for (std::int32_t i = 0; i < scene.grid.dims()[0]; ++i) {
        if (holds(tet, {double(i), double(j), double(k)}, slack)) return true;
      }
    }
  }
  return false;
}

TEST(SpuriousPockets, DenseSamplesOfSmoothSurfacesAreLeftAlone) {
  for (const char* name : {"torus", "sheets"}) {
    const auto scene = field_scene(name, 16);
    SignedDelaunay restricted = dense(*scene);
    const auto before = testing::signs_by_name(restricted);
    EXPECT_EQ(flip_spurious_pockets(restricted), 0u) << name;
    EXPECT_EQ(testing::signs_by_name(restricted), before);
  }
}

TEST(SpuriousPockets, ALoneTetrahedronWithoutASampleIsFlippedBack) {
  const auto scene = field_scene("torus", 12);
  SignedDelaunay restricted = dense(*scene);
  const Tetrahedralization& delaunay = restricted.delaunay();
  const auto before = testing::signs_by_name(restricted);
  int turned = 0;
  for (std::size_t i = 0; i < delaunay.tet_slots(); i += 7) {
    const TetId t(i);
    if (!delaunay.is_live(t) || delaunay.is_ghost(t)) continue;
    // A pocket of its own after the flip, and clearly without a sample.
    bool alone = true;
    for (unsigned face = 0; face < 4; ++face) {
      alone &= restricted.is_above(delaunay.neighbour(t, face)) == restricted.is_above(t);
    }
    if (!alone || holds_any_sample(*scene, testing::corners_of(delaunay, t), 1e-9)) continue;
    restricted.flip_sign(t);
    EXPECT_EQ(flip_spurious_pockets(restricted), 1u) << i;
    EXPECT_EQ(testing::signs_by_name(restricted), before) << i;
    if (::testing::Test::HasFailure()) return;
    ++turned;
  }
  EXPECT_GT(turned, 10);
}

TEST(SpuriousPockets, ALoneTetrahedronWithASampleOfItsSignStays) {
  // Coarse points, so tetrahedra are large and contain samples. All signs are made equal; then a tetrahedron that
  // contains a sample of the other side is no spurious pocket after its flip.
  const auto scene = field_scene("sphere", 16);
  SignedDelaunay restricted(*scene->isosurface, scene->start());
  const Tetrahedralization& delaunay = restricted.delaunay();
  int kept = 0;
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t) || delaunay.is_ghost(t)) continue;
    for (std::size_t j = 0; j < delaunay.tet_slots(); ++j) {
      if (delaunay.is_live(TetId(j)) && restricted.is_above(TetId(j))) restricted.flip_sign(TetId(j));
    }
    restricted.flip_sign(t);
    bool has_sample = false;
    for (std::int32_t n = 0; n < 16 * 16 * 16 && !has_sample; ++n) {
      const std::array<std::int32_t, 3> s{n % 16, n / 16 % 16, n / 256};
      has_sample = scene->grid.at(s[0], s[1], s[2]) > scene->isovalue &&
                   holds(testing::corners_of(delaunay, t), {double(s[0]), double(s[1]), double(s[2])}, -1e-9);
    }
    const std::size_t count = flip_spurious_pockets(restricted);
    if (has_sample) {
      EXPECT_EQ(count, 0u);
      EXPECT_TRUE(restricted.is_above(t));
      ++kept;
    }
  }
  EXPECT_GT(kept, 5);
}

TEST(SpuriousPockets, NoiseEndsAfterFewPassesAndKeepsParity) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto scene = noise_scene({5, 5, 5}, seed);
    SignedDelaunay restricted(*scene->isosurface, scene->start());
    int passes = 0;
    while (flip_spurious_pockets(restricted) > 0 && passes < 20) ++passes;
    EXPECT_LT(passes, 20) << "seed " << seed;
    EXPECT_EQ(testing::odd_edges(restricted), 0u);
  }
}

// Shares of the slots are looked at apart; pockets reach across their ends, for slots are filled in no order of place.
TEST(SpuriousPockets, AreTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto scene = noise_scene({23, 22, 22}, seed);
    SignedDelaunay restricted = dense(*scene);
    ASSERT_GT(restricted.delaunay().tet_slots(), 5 * kBlockSize);  // a share for each thread
    Rng rng(seed);
    for (int i = 0; i < 3000; ++i) {
      const TetId t(static_cast<std::size_t>(rng.below(restricted.delaunay().tet_slots())));
      if (restricted.delaunay().is_live(t)) restricted.flip_sign(t);
    }
    const std::vector<std::vector<TetId>> one = spurious_pockets(restricted, 1);
    for (const int threads : {2, 3, 5}) {
      const Shares shares(restricted.delaunay().tet_slots(), threads);
      ASSERT_EQ(shares.count(), static_cast<std::size_t>(threads));
      std::size_t across = 0;
      for (const std::vector<TetId>& pocket : one) {
        const auto [low, high] = std::minmax_element(pocket.begin(), pocket.end());
        for (std::size_t k = 1; k < shares.count(); ++k) {
          across += low->index() < shares.begin(k) && shares.begin(k) <= high->index() ? 1 : 0;
        }
      }
      EXPECT_GT(across, 3u) << "seed " << seed << ", " << threads << " threads";
      EXPECT_EQ(spurious_pockets(restricted, threads), one) << "seed " << seed << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace deliso
