// Volumes of files whose axes run backwards, and of views with negative strides: regions and messages count samples as
// the file or the caller does.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "surface/library/deliso/deliso.h"
#include "tests/support/temporary_folder.h"

namespace deliso::testing {
namespace {

constexpr std::array<std::int64_t, 3> kFileDims = {12, 10, 9};
constexpr double kBallIsovalue = 30.3;

std::size_t place_of(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<std::size_t>(i + kFileDims[0] * (j + kFileDims[1] * k));
}

// Two balls, apart along x.
std::vector<float> balls_apart() {
  std::vector<float> samples(place_of(0, 0, kFileDims[2]));
  for (std::int64_t k = 0; k < kFileDims[2]; ++k)
    for (std::int64_t j = 0; j < kFileDims[1]; ++j)
      for (std::int64_t i = 0; i < kFileDims[0]; ++i) {
        const auto x = static_cast<double>(i), y = static_cast<double>(j), z = static_cast<double>(k);
        const double low = std::hypot(x - 2.6, y - 3.4, z - 2.7) - 1.4,
                     high = std::hypot(x - 8.2, y - 5.1, z - 5.3) - 2;
        samples[place_of(i, j, k)] = static_cast<float>(30.3 - 10 * std::fmin(low, high));
      }
  return samples;
}

void write_nrrd(const std::filesystem::path& path, const std::string& directions, const std::vector<float>& samples) {
  std::string bytes(samples.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  std::ofstream(path, std::ios::binary)
      << "NRRD0005\ntype: float\ndimension: 3\nsizes: 12 10 9\nencoding: raw\nendian: "
      << (std::endian::native == std::endian::little ? "little" : "big")
      << "\nspace dimension: 3\nspace directions: " << directions << "\nspace origin: (10.1,2,3)\n\n"
      << bytes;
}

float sample_of(const VolumeView& view, std::int64_t i, std::int64_t j, std::int64_t k) {
  std::array<std::int64_t, 3> strides = view.strides;
  if (strides[0] == 0) strides = {4, 4 * view.dims[0], 4 * view.dims[0] * view.dims[1]};
  float sample = 0;
  std::memcpy(&sample, static_cast<const std::byte*>(view.samples) + i * strides[0] + j * strides[1] + k * strides[2],
              4);
  return sample;
}

TEST(LoadedVolumes, CountSamplesAsTheirFileDoes) {
  const TemporaryFolder folder;
  const std::vector<float> samples = balls_apart();
  MeshOptions options;
  options.parameters.set("region.i1", 5).set("region.j1", 7).set("region.k1", 6);
  const std::array<std::string, 4> maps = {"(0.7,0,0) (0,1,0) (0,0,1)", "(-0.7,0,0) (0,1,0) (0,0,1)",
                                           "(-0.7,0,0) (0,-1,0) (0,0,-1)", "(-0.7,0.001,0) (0,1,0) (0,0,1)"};
  for (const std::string& map : maps) {
    SCOPED_TRACE(map);
    write_nrrd(folder / "a.nrrd", map, samples);
    const LoadedVolume loaded = load_volume(folder / "a.nrrd");
    const auto& [nx, ny, nz] = loaded.view.dims;
    for (std::int64_t k = 0; k < nz; ++k)
      for (std::int64_t j = 0; j < ny; ++j)
        for (std::int64_t i = 0; i < nx; ++i) EXPECT_EQ(sample_of(loaded.view, i, j, k), samples[place_of(i, j, k)]);
    EXPECT_NEAR(loaded.view.affine[0][0], map[1] == '-' ? -0.7 : 0.7, 1e-15);
    EXPECT_EQ(loaded.view.affine[0][3], 10.1);
    // The low ball alone, of radius 1.4 around (2.6, 3.4, 2.7).
    const MeshResult result = mesh(loaded.view, kBallIsovalue, options);
    EXPECT_TRUE(result.report.proven);
    EXPECT_EQ(result.report.components, 1);
    ASSERT_FALSE(result.mesh.vertices.empty());
    for (const auto& [x, y, z] : result.mesh.vertices) {
      EXPECT_NEAR((x - 10.1) / loaded.view.affine[0][0], 2.6, 1.6);
    }
    // A packed axis, whichever way it runs, is not copied.
    EXPECT_FALSE(mesh(loaded.view, kBallIsovalue).report.copied_samples);
  }
}

TEST(LoadedVolumes, MessagesNameSamplesAsTheCallerCounts) {
  std::vector<float> samples = balls_apart();
  samples[place_of(9, 3, 2)] = std::numeric_limits<float>::quiet_NaN();
  VolumeView view = view_of(samples.data(), kFileDims);
  const auto error_of_mesh = [&](const MeshOptions& options) -> std::string {
    try {
      mesh(view, kBallIsovalue, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  MeshOptions of_part;
  of_part.parameters.set("region.j0", 2).set("region.k0", 1);
  for (const MeshOptions& options : {MeshOptions(), of_part}) {
    EXPECT_NE(error_of_mesh(options).find("sample (9, 3, 2) is NaN"), std::string::npos) << error_of_mesh(options);
  }
  // The same samples from the other ends of x and z.
  view.samples = samples.data() + place_of(kFileDims[0] - 1, 0, kFileDims[2] - 1);
  view.strides = {-4, 4 * kFileDims[0], -4 * kFileDims[0] * kFileDims[1]};
  for (const MeshOptions& options : {MeshOptions(), of_part}) {
    EXPECT_NE(error_of_mesh(options).find("sample (2, 3, 6) is NaN"), std::string::npos) << error_of_mesh(options);
  }
}

}  // namespace
}  // namespace deliso::testing
