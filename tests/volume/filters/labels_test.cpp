// Masks and labels, recognised and taken apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/filters/labels.h"
#include "volume/filters/meshed_field.h"

namespace deliso {
namespace {

// Blocks of labels, four samples wide.
std::vector<std::int16_t> blocks(int size, int labels) {
  std::vector<std::int16_t> samples;
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) samples.push_back(static_cast<std::int16_t>((i / 8 + j / 8 + k / 8) % labels - 1));
  return samples;
}

// An atlas has more values than can be listed; what is wrong is that this one is not among them.
TEST(Labels, OneThatNoSampleHasIsRefusedWithTheRange) {
  const auto refusal = [](const ScalarGrid& grid) -> std::string {
    try {
      check_labels(grid, {1, 5000});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  std::vector<std::int16_t> many;
  for (int i = 0; i < 512; ++i) many.push_back(static_cast<std::int16_t>(i % 117));
  EXPECT_EQ(refusal(ScalarGrid({8, 8, 8}, many)),
            "no sample has the label 5000: the samples are whole numbers from 0 to 116");
  std::vector<float> field(many.begin(), many.end());
  field[3] = 2.5f;
  EXPECT_EQ(
      refusal(ScalarGrid({8, 8, 8}, field)),
      "no sample has the label 5000: the samples are numbers from 0 to 116 that are not all whole, so they are no "
      "labels");
  EXPECT_EQ(refusal(ScalarGrid({32, 32, 32}, blocks(32, 4))),
            "no sample has the label 5000: the samples are the values -1, 0, 1, 2");
}

TEST(Labels, AreRecognised) {
  Rng rng(1);
  std::vector<std::uint8_t> noise(512), mask(512);
  for (std::uint8_t& sample : noise) sample = static_cast<std::uint8_t>(rng.below(4));
  for (std::uint8_t& sample : mask) sample = static_cast<std::uint8_t>(255 * rng.below(2));
  EXPECT_EQ(kind_of_samples(ScalarGrid({8, 8, 8}, noise)).kind, SampleKind::kField);
  const SampleKinds two = kind_of_samples(ScalarGrid({8, 8, 8}, mask));
  EXPECT_EQ(two.kind, SampleKind::kMask);
  EXPECT_EQ(two.values, (std::vector<double>{0, 255}));
  const SampleKinds labels = kind_of_samples(ScalarGrid({32, 32, 32}, blocks(32, 4)));
  EXPECT_EQ(labels.kind, SampleKind::kLabels);
  EXPECT_EQ(labels.values, (std::vector<double>{-1, 0, 1, 2}));
  // Floats may hold a mask, too, but halves are none.
  EXPECT_EQ(kind_of_samples(ScalarGrid({2, 2, 2}, std::vector<float>{0, 0, 0, 1, 1, 1, 0, 0})).kind, SampleKind::kMask);
  EXPECT_EQ(kind_of_samples(ScalarGrid({2, 2, 2}, std::vector<float>{0, 0, 0, 0.5, 0.5, 0, 0, 0})).kind,
            SampleKind::kField);
  EXPECT_EQ(kind_of_samples(ScalarGrid({2, 2, 2}, std::vector<float>(8, 1))).kind, SampleKind::kField);
  for (const char* name : {"sphere", "gyroid", "shells"}) {
    EXPECT_EQ(kind_of_samples(generate_field(name, 24)).kind, SampleKind::kField) << name;
  }
}

// A solid that was sampled several times within each voxel: few whole numbers in patches, with those between at its
// edges.
TEST(Labels, AMaskWithSoftEdgesIsAField) {
  std::vector<std::uint8_t> soft, thin;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        const double inside = 10.3 - std::hypot(i - 15.5, j - 15.2, k - 15.9);
        soft.push_back(static_cast<std::uint8_t>(4 * std::lround(std::clamp(8 + 16 * inside, 0.0, 16.0))));
        // Labels in order of no meaning, the fourth of every five in a layer of one sample.
        thin.push_back(static_cast<std::uint8_t>(i % 5 == 3 && j % 8 == 0 ? 7 : 11 * (i / 16 + j / 16) + k / 8));
      }
  EXPECT_EQ(kind_of_samples(ScalarGrid({32, 32, 32}, soft)).kind, SampleKind::kField);
  const SampleKinds labels = kind_of_samples(ScalarGrid({32, 32, 32}, thin));
  EXPECT_EQ(labels.kind, SampleKind::kLabels);
  EXPECT_GT(labels.values.size(), 8u);
}

TEST(Labels, BecomeMasks) {
  const std::vector<std::int16_t> samples = blocks(16, 3);
  const ScalarGrid grid({16, 16, 16}, samples, {1, 2, 3}, {4, 5, 6});
  for (const std::int32_t label : {-1, 0, 1}) {
    std::vector<std::uint8_t> by_hand;
    for (const std::int16_t sample : samples) by_hand.push_back(sample == label ? 1 : 0);
    const ScalarGrid mask = label_mask(grid, label);
    EXPECT_EQ(mask.samples(), Samples(SampleArray<std::uint8_t>(by_hand)));
    EXPECT_EQ(mask.spacing(), grid.spacing());
    EXPECT_EQ(mask.origin(), grid.origin());
  }
  try {
    label_mask(grid, 7);
    FAIL() << "there is no label 7";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the values -1, 0, 1"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(check_labels(grid, {1, -1}));
  EXPECT_THROW(check_labels(grid, {1, 7, -1}), InputError);
}

TEST(MeshedField, DoesInOrderWhatItIsAskedFor) {
  const ScalarGrid grid({16, 16, 16}, blocks(16, 3));
  // Nothing to do: the same memory.
  const MeshedField same = meshed_field(grid, 0.5, {}, false, {1, 1, 1}, 1);
  EXPECT_EQ(std::get<SampleArray<std::int16_t>>(same.grid.samples()).data(),
            std::get<SampleArray<std::int16_t>>(grid.samples()).data());
  FieldParameters parameters;
  parameters.label = 1;
  const MeshedField label = meshed_field(grid, 99, parameters, false, {1, 1, 1}, 1);
  EXPECT_EQ(label.isovalue, 0.5);
  EXPECT_EQ(label.grid.range(), std::pair(0.0, 1.0));
  parameters.smooth = 1;
  const MeshedField smooth = meshed_field(grid, 99, parameters, false, {1, 1, 1}, 1);
  EXPECT_EQ(smooth.grid.type_name(), "f32");
  EXPECT_EQ(field_text(parameters), "label 1, smoothed (sigma 1 voxel)");
  EXPECT_EQ(field_text({}), "");
  // After smoothing nothing of a speck may be left.
  std::vector<std::uint8_t> speck(343, 0);
  speck[171] = 1;
  parameters.label.reset();
  EXPECT_THROW(meshed_field(ScalarGrid({7, 7, 7}, speck), 0.5, parameters, false, {1, 1, 1}, 1), InputError);
}

// The layer that closes a solid would be infinite.
TEST(MeshedField, RefusesWhatIsTooLargeToBeClosed) {
  const ScalarGrid grid({16, 16, 16}, blocks(16, 3));
  EXPECT_NO_THROW(meshed_field(grid, -1e290, {}, true, {1, 1, 1}, 1));
  EXPECT_THROW(meshed_field(grid, -1.1e290, {}, true, {1, 1, 1}, 1), InputError);
  std::vector<double> samples(8, 0.0);
  samples[3] = 1.1e290;
  const ScalarGrid large({2, 2, 2}, std::move(samples));
  EXPECT_THROW(meshed_field(large, 1, {}, true, {1, 1, 1}, 1), InputError);
  EXPECT_NO_THROW(meshed_field(large, 1, {}, false, {1, 1, 1}, 1));
}

}  // namespace
}  // namespace deliso
