// Meshes that the library makes and saves, before the program's second opinion, which takes what it has to know from
// their files; and what both say of one mesh.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "surface/library/deliso/deliso.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// Two balls apart.
constexpr std::array<std::int64_t, 3> kBallsSides = {20, 14, 13};
std::vector<float> balls_apart() {
  std::vector<float> samples;
  for (int k = 0; k < kBallsSides[2]; ++k)
    for (int j = 0; j < kBallsSides[1]; ++j)
      for (int i = 0; i < kBallsSides[0]; ++i) {
        const double a = 4.6 - std::hypot(i - 6.2, j - 6.3, k - 6.1), b = 2.7 - std::hypot(i - 15.4, j - 6.6, k - 6.4);
        samples.push_back(static_cast<float>(std::fmax(a, b)));
      }
  return samples;
}

class LibraryMesh : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string bytes(reinterpret_cast<const char*>(samples_.data()), samples_.size() * sizeof(float));
    write_file(folder_ / "v.nrrd",
               std::string("NRRD0005\ntype: float\ndimension: 3\nsizes: 20 14 13\nencoding: raw\n") +
                   "endian: little\nspace dimension: 3\nspace directions: (1,0,0) (3,1,0) " +
                   "(0,0,1)\nspace origin: (0,0,0)\n\n" + bytes);
    view_ = view_of(samples_.data(), kBallsSides);
    view_.affine = {{{1, 3, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  }

  TemporaryFolder folder_;
  std::vector<float> samples_ = balls_apart();
  VolumeView view_;
};

TEST_F(LibraryMesh, IsVerifiedByWhatItsFileSays) {
  const std::vector<std::vector<std::pair<std::string, ParameterInput>>> ways = {
      {},
      {{"components.keep_largest", std::int64_t{1}}},
      {{"field.invert", true}},
      {{"boundary", "closed"}, {"field.smooth", 0.6}},
      {{"region.i1", std::int64_t{12}}, {"promise.max_distance", 0.5}},
      {{"size.max_error", 1.5}},
  };
  for (const auto& way : ways) {
    SCOPED_TRACE(way.empty() ? "defaults" : way.front().first);
    MeshOptions options;
    for (const auto& [name, value] : way) options.parameters.set(name, value);
    const MeshResult result = mesh(view_, 0.1, options);
    ASSERT_TRUE(result.report.proven);
    for (const char* const name : {"m.ply", "m.stl"}) {
      save_mesh(result.mesh, folder_ / name);
      const ProgramResult verified = run_deliso({"verify", folder_ / name, folder_ / "v.nrrd", "--isovalue", "0.1"});
      EXPECT_EQ(verified.exit_code, 0) << name << verified.out << verified.err;
    }
  }
}

TEST_F(LibraryMesh, HasTheAnglesThatTheProgramTells) {
  const MeshResult result = mesh(view_, 0.1);
  ASSERT_EQ(run_deliso({"mesh", folder_ / "v.nrrd", "--isovalue", "0.1", "-o", folder_ / "m.ply", "--report",
                        folder_ / "r.json"})
                .exit_code,
            0);
  const Json report = read_json(folder_ / "r.json");
  EXPECT_NEAR(report["quality"]["min_angle_degrees"].get<double>(), result.report.min_angle_degrees, 1e-9);
  EXPECT_NEAR(report["quality"]["max_angle_degrees"].get<double>(), result.report.max_angle_degrees, 1e-9);
}

}  // namespace
}  // namespace deliso::testing
