// Boxes around bad triangles that crowd: in several passes, each triangle in one of them, patches of a pass apart.
#include "surface/shape/patch_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace deliso {
namespace {

// Small triangles all over a plate, closer to each other than their boxes are large.
SurfaceMesh crowd(int across, double size) {
  SurfaceMesh mesh;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < across; ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      const Vec3 p{1.0 + i, 1.0 + j, 20.25};
      mesh.points.insert(mesh.points.end(), {p, p + Vec3{size, 0, 0}, p + Vec3{0, size, 0}});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return mesh;
}

std::vector<std::uint32_t> all_of(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::size_t patches_of(const PatchBoxes::Pass& pass) {
  return pass.patch_of.empty() ? 0 : *std::max_element(pass.patch_of.begin(), pass.patch_of.end()) + 1;
}

TEST(PatchBoxes, EachTriangleBelongsToOnePassAndPatchesOfAPassAreApart) {
  const SurfaceMesh mesh = crowd(150, 0.2);
  const PatchBoxes boxes(mesh, all_of(mesh), 3, 1000);
  std::vector<int> found(mesh.triangles.size(), 0);
  std::size_t most = 0, largest = 0;
  for (std::size_t pass = 0; pass < boxes.passes().size(); ++pass) {
    const PatchBoxes::Pass& part = boxes.passes()[pass];
    most = std::max(most, patches_of(part));
    for (std::uint32_t i = 0; i < part.patch_of.size(); ++i) {
      largest = std::max(
          largest, static_cast<std::size_t>(std::count(part.patch_of.begin(), part.patch_of.end(), part.patch_of[i])));
      for (std::uint32_t j = 0; j < i; ++j) {
        if (part.patch_of[i] == part.patch_of[j]) continue;
        EXPECT_FALSE(part.boxes.boxes()[i].meets(part.boxes.boxes()[j])) << i << " and " << j << " of pass " << pass;
      }
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto box = boxes.box_of(mesh, t, pass);
      if (!box) continue;
      ++found[t];
      EXPECT_TRUE(part.boxes.boxes()[*box].contains(mesh.points[mesh.triangles[t][0]]));
    }
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), 1), static_cast<std::ptrdiff_t>(found.size()));
  EXPECT_EQ(boxes.passes().size(), 3u);  // no block cuts the plate along z, so along x and y at most two passes do
  EXPECT_GE(most, 9u);
  EXPECT_LE(largest, 48u * 48u);
}

TEST(PatchBoxes, ASmallCrowdIsOnePatchAndLargeBoxesHaveALastPass) {
  const SurfaceMesh mesh = crowd(150, 0.2);
  const PatchBoxes whole(mesh, all_of(mesh), 3, mesh.triangles.size());
  ASSERT_EQ(whole.passes().size(), 1u);
  EXPECT_EQ(patches_of(whole.passes()[0]), 1u);
  // Boxes of 13 and more do not fit into a quarter of a block.
  const SurfaceMesh large = crowd(60, 2);
  const PatchBoxes divided(large, all_of(large), 3, 1000);
  EXPECT_EQ(divided.passes().size(), 3u);
  for (const PatchBoxes::Pass& pass : divided.passes()) EXPECT_GT(patches_of(pass), 0u);
  // None of these fits into a block: the passes by blocks would be empty.
  const SurfaceMesh huge = crowd(40, 20);
  const PatchBoxes together(huge, all_of(huge), 3, 1000);
  ASSERT_EQ(together.passes().size(), 1u);
  EXPECT_EQ(patches_of(together.passes()[0]), 1u);
}

}  // namespace
}  // namespace deliso
