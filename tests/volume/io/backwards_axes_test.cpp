// Axes that run backwards along an axis of the world are reversed on reading; samples are counted as the file counts
// them all the same: in regions, in the map to the world, in messages.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/volume_files.h"
#include "volume/io/volume_file.h"
#include "volume/region.h"

namespace deliso {
namespace {

template <class Number>
std::string host_bytes(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

const std::string kHostOrder = std::endian::native == std::endian::little ? "little" : "big";

// 5 x 4 x 3 samples.
std::string nrrd_with_axes(const std::string& type, const std::string& directions, const std::string& data) {
  return "NRRD0005\ntype: " + type + "\ndimension: 3\nsizes: 5 4 3\nendian: " + kHostOrder +
         "\nencoding: raw\nspace dimension: 3\nspace directions: " + directions + "\nspace origin: (10.1,20,30)\n\n" +
         data;
}

class BackwardsAxes : public testing::Test {
 protected:
  Volume read(const std::string& content, bool accepts_not_finite = false) {
    write_text(directory_ / "a.nrrd", content);
    ReadOptions options;
    options.accepts_not_finite = accepts_not_finite;
    return read_placed_volume(directory_ / "a.nrrd", options);
  }
  TemporaryFolder directory_;
};

TEST_F(BackwardsAxes, ARegionHoldsTheSamplesThatTheFileCounts) {
  std::vector<float> samples(60);
  std::iota(samples.begin(), samples.end(), 0.0f);
  const SampleRegion region = parse_region("0:1,:2,1:", "r");
  // The last is askew, and never reversed: the samples of its region are what all others must have.
  const std::vector<std::string> maps = {"(-0.7,0,0) (0,2,0) (0,0,1)", "(0.7,0,0) (0,-2,0) (0,0,-1)",
                                         "(-0.7,0,0) (0,-2,0) (0,0,-1)", "(-0.7,0.001,0) (0,2,0) (0,0,1)"};
  for (const std::string& map : maps) {
    SCOPED_TRACE(map);
    const Volume volume = read(nrrd_with_axes("float", map, host_bytes(samples)));
    const ScalarGrid part = cropped(volume.grid, region);
    ASSERT_EQ(part.dims(), (Dims{2, 3, 2}));
    EXPECT_EQ(part.backwards(), volume.grid.backwards());
    for (std::int32_t k = 0; k < 2; ++k) {
      for (std::int32_t j = 0; j < 3; ++j) {
        for (std::int32_t i = 0; i < 2; ++i) {
          const auto [x, y, z] = part.backwards();
          const std::int32_t fi = x ? 1 - i : i, fj = y ? 2 - j : j, fk = z ? 1 - k : k;  // in the region, by the file
          const auto value = static_cast<double>(fi + 5 * (fj + 4 * (fk + 1)));
          EXPECT_EQ(part.at(i, j, k), value);
          // It stays in its place, where the file's map has it.
          const Vec3 s = part.spacing();
          const Vec3 place = volume.placement.to_world(part.origin() + Vec3{i * s.x, j * s.y, k * s.z});
          const Vec3 expected = volume.index_to_world(Vec3{1.0 * fi, 1.0 * fj, fk + 1.0});
          EXPECT_LT(norm(place - expected), 1e-12);
        }
      }
    }
    // Samples that need not be finite, likewise.
    EXPECT_EQ(cropped(volume.grid.samples(), volume.grid, region), part.samples());
  }
}

TEST_F(BackwardsAxes, TheMapIsThatOfTheFileToTheLastBit) {
  const Volume volume = read(nrrd_with_axes("uint8", "(-0.7,0,0) (0,2,0) (0,0,-1)", std::string(60, 'a')));
  EXPECT_EQ(volume.grid.backwards(), (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(volume.index_to_world.offset, (Vec3{10.1, 20, 30}));
  EXPECT_EQ(volume.index_to_world.columns[0], (Vec3{-0.7, 0, 0}));
  EXPECT_EQ(volume.index_to_world.columns[2], (Vec3{0, 0, -1}));
  EXPECT_TRUE(volume.placement.is_identity());
  const Volume askew = read(nrrd_with_axes("uint8", "(-0.7,0.1,0) (0,2,0) (0,0,-1)", std::string(60, 'a')));
  EXPECT_EQ(askew.grid.backwards(), (std::array<bool, 3>{}));
  EXPECT_EQ(askew.index_to_world.columns[0], (Vec3{-0.7, 0.1, 0}));
}

TEST_F(BackwardsAxes, MessagesNameSamplesAsTheFileCounts) {
  std::vector<float> samples(60, 1);
  samples[1 + 5 * (2 + 4 * 2)] = std::numeric_limits<float>::quiet_NaN();
  for (const std::string map :
       {"(0.7,0,0) (0,2,0) (0,0,1)", "(-0.7,0,0) (0,2,0) (0,0,-1)", "(1,1,0) (0,1,0) (0,0,1)"}) {
    const std::string content = nrrd_with_axes("float", map, host_bytes(samples));
    expect_input_error([&] { read(content); }, {"sample (1, 2, 2) is NaN"});
    const Volume volume = read(content, true);
    EXPECT_EQ(first_not_finite_text(*volume.as_read, volume.grid, {10, 0, 0}), "sample (11, 2, 2) is NaN");
  }
  std::vector<std::uint64_t> wide(60, 1);
  wide[1 + 5 * (2 + 4 * 2)] = (std::uint64_t{1} << 53) + 1;
  const std::string content = nrrd_with_axes("uint64", "(-1,0,0) (0,-1,0) (0,0,-1)", host_bytes(wide));
  expect_input_error([&] { read(content); }, {"sample (1, 2, 2) is 9007199254740993"});
}

// Of an array in Fortran's order z is the fastest axis.
TEST_F(BackwardsAxes, MessagesNameSamplesOfArraysInFortransOrder) {
  std::vector<std::uint64_t> wide(60, 1);
  wide[2 + 3 * (1 + 4 * 4)] = (std::uint64_t{1} << 53) + 1;  // sample (4, 1, 2) is element [2, 1, 4]
  std::string header = "{'descr': '<u8', 'fortran_order': True, 'shape': (3, 4, 5), }";
  if (kHostOrder == "big") header[11] = '>';
  header.resize(117, ' ');
  header += '\n';
  write_text(directory_ / "a.npy", std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + host_bytes(wide));
  expect_input_error([&] { read_placed_volume(directory_ / "a.npy"); }, {"sample (4, 1, 2) is 9007199254740993"});
}

}  // namespace
}  // namespace deliso
