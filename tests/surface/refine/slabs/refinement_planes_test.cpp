// Where stage 2 cuts the mesh into slabs.
#include "surface/refine/slabs/refinement_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/wavy_square.h"

namespace deliso {
namespace {

using testing::wavy_square;

TEST(RefinementPlanes, SmallMeshesAreOneSlab) {
  const RefinementMesh whole(wavy_square(20));
  const std::vector<Slab> slabs = slabs_of_equal_work(whole, std::vector<float>(whole.triangles.size(), 1), 8192);
  ASSERT_EQ(slabs.size(), 1u);
  EXPECT_TRUE(slabs[0].contains({-1e300, 0, 1e300}));
}

// Of each slab: the work of the triangles whose middles lie in it, as a part of all; of each plane: what it cuts.
struct Shares {
  std::vector<double> of_slabs, of_planes;
};
Shares shares_of(const RefinementMesh& mesh, const std::vector<Slab>& slabs, const std::vector<float>& work) {
  Shares shares{std::vector<double>(slabs.size()), std::vector<double>(slabs.size() - 1)};
  double all = 0;
  for (std::uint32_t t = 0; t < work.size(); ++t) {
    const Box3 box = mesh.box_of(t);
    const std::size_t axis = slabs[0].axis;
    const double middle = 0.5 * (box.low[axis] + box.high[axis]);
    all += work[t] + 0.5;
    for (std::size_t k = 0; k < slabs.size(); ++k) {
      if (slabs[k].low <= middle && middle < slabs[k].high) shares.of_slabs[k] += work[t] + 0.5;
      const bool is_cut = box.low[axis] <= slabs[k].high && slabs[k].high <= box.high[axis];
      if (k + 1 < slabs.size() && is_cut) shares.of_planes[k] += work[t];
    }
  }
  for (double& share : shares.of_slabs) share /= all;
  for (double& share : shares.of_planes) share /= all;
  return shares;
}

TEST(RefinementPlanes, SlabsHaveAboutTheSameWork) {
  const RefinementMesh mesh(wavy_square(120));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) work[t] = static_cast<float>(mesh.corner(t, 0).x * 0.2);
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  ASSERT_EQ(slabs.size(), 4u);
  for (std::size_t k = 0; k + 1 < slabs.size(); ++k) {
    EXPECT_EQ(slabs[k].high, slabs[k + 1].low);
    EXPECT_EQ(slabs[k].axis, slabs[0].axis);
  }
  for (const double share : shares_of(mesh, slabs, work).of_slabs) EXPECT_NEAR(share, 0.25, 0.08);
}

TEST(RefinementPlanes, ThereIsAnEvenNumberOfSlabs) {
  const RefinementMesh mesh(wavy_square(120));
  const std::vector<float> work(mesh.triangles.size(), 1);
  for (const std::size_t in_slab : {20'000u, 12'000u, 9'600u, 7'200u, 5'760u, 4'000u, 1'000u}) {
    const std::size_t count = slabs_of_equal_work(mesh, work, in_slab).size();
    EXPECT_TRUE(count == 1 || count % 2 == 0) << in_slab;
    EXPECT_LE(count, 10u) << in_slab;
    EXPECT_NEAR(static_cast<double>(count), std::min(10.0, 28'800.0 / static_cast<double>(in_slab)), 1) << in_slab;
  }
}

// Work alone counts that is left: every second row of squares is coarse, the more the farther from the middle.
TEST(RefinementPlanes, TheSlabWithTheMostWorkLeftComesFirst) {
  RefinementMesh mesh(wavy_square(60));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) {
    const double y = mesh.box_of(t).low.y;
    mesh.triangles[t].set(RefinementMesh::Triangle::kCoarse, std::fmod(y, 2) == 0);
    work[t] = static_cast<float>(std::fmod(y, 2) == 0 ? std::abs(y - 31) : 1000 + y);
  }
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Slab> in_order = {{1, -inf, 10}, {1, 10, 40}, {1, 40, 50}, {1, 50, inf}};
  const auto left_in = [&](const Slab& slab) {
    double left = 0;
    for (std::uint32_t t = 0; t < work.size(); ++t) {
      const double middle = mesh.box_of(t).low.y + 0.5;
      if (mesh.triangles[t].is_coarse() && slab.low < middle && middle < slab.high) left += work[t];
    }
    return left;
  };
  const std::vector<Slab> slabs = most_work_first(in_order, mesh, work);
  ASSERT_EQ(slabs.size(), in_order.size());
  double sum = 0;
  for (const Slab& slab : slabs) sum += left_in(slab);
  for (std::size_t k = 1; k < slabs.size(); ++k) EXPECT_GT(left_in(slabs[k - 1]), left_in(slabs[k]));
  EXPECT_EQ(sum, left_in({1, -inf, inf}));
  EXPECT_EQ(slabs.front().low, 10);
  EXPECT_EQ(slabs.back().low, 40);
}

TEST(RefinementPlanes, PlanesKeepOutOfCoarsePlaces) {
  // Coarse stripes where equal shares would have the planes.
  const RefinementMesh mesh(wavy_square(128));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) work[t] = std::fmod(mesh.box_of(t).low.y + 1, 4) < 2 ? 100 : 1;
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  ASSERT_EQ(slabs.size(), 4u);
  ASSERT_EQ(slabs[0].axis, 1u);
  for (const double share : shares_of(mesh, slabs, work).of_planes) EXPECT_LT(share, 2.0 / 128 / 50);
}

TEST(RefinementPlanes, SeamsHoldWhatIsCoarseAtThePlanes) {
  RefinementMesh mesh(wavy_square(128));
  // Triangles of every third row are coarse.
  const auto is_coarse = [&](std::uint32_t t) { return std::fmod(mesh.box_of(t).low.y, 3) == 0; };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangles[t].set(RefinementMesh::Triangle::kCoarse, is_coarse(t));
  }
  const double inf = std::numeric_limits<double>::infinity();
  // One plane within a coarse row, one in a row that is not, and one between two rows, the upper one coarse.
  const std::vector<Slab> slabs = {{1, -inf, 30.5}, {1, 30.5, 31.75}, {1, 31.75, 60}, {1, 60, inf}};
  const std::vector<Slab> seams = seams_between(slabs, mesh, 2);
  ASSERT_EQ(seams.size(), 3u);
  EXPECT_EQ(seams[0].low, 29);                   // the row from 30 to 31 and its own height around it,
  EXPECT_EQ(seams[0].high, (30.5 + 31.75) / 2);  // but no farther than the middle of the next slab
  EXPECT_EQ(seams[1].low, seams[1].high);        // nothing
  EXPECT_EQ(seams[2].low, 59);
  EXPECT_EQ(seams[2].high, 62);
  for (const Slab& seam : seams) EXPECT_EQ(seam.axis, 1u);
}

TEST(RefinementPlanes, SeamsLeaveFreeWhatMeetsThePlanes) {
  const RefinementMesh mesh(wavy_square(120));
  const std::vector<float> work(mesh.triangles.size(), 1);
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  RefinementMesh coarse = mesh;
  for (auto& triangle : coarse.triangles) triangle.set(RefinementMesh::Triangle::kCoarse, true);
  const std::vector<Slab> seams = seams_between(slabs, coarse);
  ASSERT_EQ(slabs.size(), 4u);
  ASSERT_EQ(seams.size(), 3u);
  for (std::uint32_t t = 0; t < coarse.triangles.size(); ++t) {
    const Box3 box = coarse.box_of(t);
    for (std::size_t k = 0; k < seams.size(); ++k) {
      const double plane = slabs[k].high;
      const std::size_t axis = slabs[k].axis;
      if (box.low[axis] > plane || box.high[axis] < plane) continue;
      EXPECT_LT(seams[k].low, box.low[axis]);  // free to be refined there
      EXPECT_GT(seams[k].high, box.high[axis]);
    }
  }
  for (std::size_t k = 0; k + 1 < seams.size(); ++k) EXPECT_LE(seams[k].high, seams[k + 1].low);
}

}  // namespace
}  // namespace deliso
