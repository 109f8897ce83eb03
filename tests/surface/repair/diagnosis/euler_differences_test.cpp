// Where the topology of meshes differs from the surface's: all components at once must give the same as one after the
// other.
#include "surface/repair/diagnosis/euler_differences.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/repair/diagnosis/angle_defect_grid.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/rounds/round.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

constexpr std::size_t kMany = 1u << 30;

class EulerDifferencesOfNoise : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  explicit EulerDifferencesOfNoise(const Dims& dims = {12, 11, 10})
      : scene_(testing::noise_scene(dims, GetParam())), cache_(scene_->surface()) {
    std::vector<Vec3> samples;
    for (std::size_t i = 0; i < scene_->topology.crossings.size(); i += 2) {
      const EdgeCrossing& crossing = scene_->topology.crossings[i];
      samples.push_back(scaled(crossing_position(scene_->grid, crossing), scene_->isosurface->step()));
    }
    CellLevels cells(*scene_->isosurface);
    RepairRound round(scene_->surface(), cells, std::make_unique<SignedDelaunay>(*scene_->isosurface, samples));
    round.take_plain_signs();
    mesh_ = std::make_shared<MatchedMesh>(round.assemble());
  }
  [[nodiscard]] std::size_t components() const { return scene_->topology.components.size(); }
  // The boxes from one component's main piece and its part of the surface alone, both as whole meshes.
  [[nodiscard]] IndexRanges boxes_of(std::uint32_t c) const {
    const ExactPolygonization& exact = cache_.polygonized();
    const std::vector<std::uint32_t> in_mesh = part_where(mesh_->match.piece_of, mesh_->match.main_piece[c]);
    const std::vector<std::uint32_t> on_surface = part_where(exact.component, c);
    const Vec3& step = scene_->isosurface->step();
    const Dims& dims = scene_->grid.dims();
    auto boxes = EulerBoxes::around(jumps_between(euler_curves(mesh_->built.mesh, in_mesh, 1, step, dims).front(),
                                                  euler_curves(exact.mesh, on_surface, 1, step, dims).front()),
                                    dims, kMany);
    if (!boxes) return {};
    const auto adds = [&](std::int32_t sign) {
      return [&boxes, sign](std::uint32_t, const SampleLayers& layers, std::int32_t change) {
        boxes->add(layers, sign * change);
      };
    };
    for_each_mesh_change(mesh_->built.mesh, in_mesh, step, dims, adds(1));
    for_each_mesh_change(exact.mesh, on_surface, step, dims, adds(-1));
    return boxes->boxes();
  }
  static std::vector<std::uint32_t> part_where(const std::vector<std::uint32_t>& names, std::uint32_t wanted) {
    std::vector<std::uint32_t> part;
    for (const std::uint32_t name : names) part.push_back(name == wanted ? 0 : kNoPart);
    return part;
  }

  std::unique_ptr<testing::Scene> scene_;
  ExactSurfaceCache cache_;
  std::shared_ptr<MatchedMesh> mesh_;
};

TEST_P(EulerDifferencesOfNoise, AreThoseOfEachComponentAlone) {
  EulerDifferences differences(cache_);
  const std::vector<IndexRanges> boxes =
      differences.find(mesh_, std::vector<bool>(components(), false), {kMany, false});
  ASSERT_EQ(boxes.size(), components());
  int wrong = 0;
  for (std::uint32_t c = 0; c < components(); ++c) {
    const bool is_wrong = mesh_->match.main_piece[c] != kNoPiece && mesh_->match.agreement[c] == Agreement::kNone;
    EXPECT_EQ(boxes[c], is_wrong ? boxes_of(c) : IndexRanges()) << c;
    wrong += is_wrong ? 1 : 0;
  }
  EXPECT_GT(wrong, 0);
}

TEST_P(EulerDifferencesOfNoise, AreNoMoreThanAskedForAndNoneOfWhatIsDone) {
  EulerDifferences differences(cache_);
  const std::vector<bool> none_done(components(), false);
  const std::vector<IndexRanges> all = differences.find(mesh_, none_done, {kMany, false});
  std::size_t most = 0;
  for (const IndexRanges& boxes : all) most = std::max(most, boxes.all.size());
  ASSERT_GT(most, 0u);
  const std::vector<IndexRanges> fewer = differences.find(mesh_, none_done, {most - 1, false});
  for (std::size_t c = 0; c < components(); ++c) {
    EXPECT_EQ(fewer[c], all[c].all.size() < most ? all[c] : IndexRanges());
  }
  const std::vector<IndexRanges> again = differences.find(mesh_, none_done, {kMany, false});
  for (std::size_t c = 0; c < components(); ++c) EXPECT_EQ(again[c], all[c]);
  EulerDifferences others(cache_);
  for (const IndexRanges& boxes : others.find(mesh_, std::vector<bool>(components(), true), {kMany, false})) {
    EXPECT_TRUE(boxes.all.empty());
  }
}

// Noise in which Euler curves give many boxes or wide ones.
class EulerDifferencesOfMuchNoise : public EulerDifferencesOfNoise {
 protected:
  EulerDifferencesOfMuchNoise() : EulerDifferencesOfNoise({26, 25, 24}) {}
};

TEST_P(EulerDifferencesOfMuchNoise, TakeTheBoxesOfAngleDefectsWhenAskedAndEulerCurvesAreUnclear) {
  const Vec3& step = scene_->isosurface->step();
  const auto& [exact, component_of] = cache_.polygonized();
  int found = 0;
  for (std::uint32_t c = 0; c < components(); ++c) {
    const std::uint32_t main = mesh_->match.main_piece[c];
    if (main == kNoPiece || mesh_->match.agreement[c] != Agreement::kNone) continue;
    std::vector<bool> others_done(components(), true);
    others_done[c] = false;
    EulerDifferences differences(cache_);
    const IndexRanges by_curves = differences.find(mesh_, others_done, {kMany, false})[c];
    const IndexRanges both = differences.find(mesh_, others_done, {kMany, true})[c];
    AngleDefectGrid grid(scene_->grid.dims(), step);
    AngleDefectGrid exact_grid = grid;
    grid.add(mesh_->built.mesh, [&](std::uint32_t v) { return mesh_->match.piece_of[v] == main; });
    exact_grid.add(exact, [&, &component_of = component_of](std::uint32_t v) { return component_of[v] == c; });
    grid.subtract(exact_grid);
    const std::int64_t too_much =
        mesh_->match.pieces[main].topology.euler_characteristic - scene_->topology.components[c].euler_characteristic;
    const std::vector<IndexBox> boxes = grid.places(too_much > 0, 16);
    const auto is_narrow = [](const IndexBox& box) {
      return std::all_of(box.begin(), box.end(), [](const LayerRange& range) { return range.last - range.first < 16; });
    };
    const bool is_clear = !by_curves.all.empty() && by_curves.all.size() <= 8 &&
                          std::all_of(by_curves.all.begin(), by_curves.all.end(), is_narrow);
    if (too_much == 0 || boxes.empty() || is_clear) {
      EXPECT_EQ(both, by_curves);
      continue;
    }
    ++found;
    EXPECT_EQ(both.likely, boxes);
    for (const IndexBox& box : by_curves.all)
      EXPECT_NE(std::find(both.all.begin(), both.all.end(), box), both.all.end());
    for (const IndexBox& box : boxes) EXPECT_NE(std::find(both.all.begin(), both.all.end(), box), both.all.end());
  }
  EXPECT_GT(found, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, EulerDifferencesOfNoise, ::testing::Values(1, 2, 3, 4));
INSTANTIATE_TEST_SUITE_P(Seeds, EulerDifferencesOfMuchNoise, ::testing::Values(1, 2));

}  // namespace
}  // namespace deliso
