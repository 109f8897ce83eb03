// The library's one header, used as others use it: what it says of samples in memory, threads, stops and errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "surface/library/deliso/deliso.h"
#include "tests/support/temporary_folder.h"

namespace deliso::testing {
namespace {

constexpr std::array<std::int64_t, 3> kDims = {14, 16, 18};
constexpr double kIsovalue = 20.5;

// Two overlapping balls that no symmetry of the box maps to themselves, as whole numbers from 0 to 100.
double field_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  const auto x = static_cast<double>(i), y = static_cast<double>(j), z = static_cast<double>(k);
  const double a = std::hypot(x - 5.3, y - 6.1, z - 6.7), b = std::hypot(x - 7.9, y - 9.2, z - 11.1);
  return std::clamp(std::round(60 - 10 * std::min(a, b + 0.7)), 0.0, 100.0);
}

// Samples with any strides, in elements; the first one lies at `first`.
template <class Sample>
struct Stored {
  std::vector<Sample> memory;
  VolumeView view;
};
template <class Sample>
Stored<Sample> stored(const std::array<std::int64_t, 3>& strides, std::int64_t first, std::size_t size) {
  Stored<Sample> out;
  out.memory.resize(size);
  for (std::int64_t k = 0; k < kDims[2]; ++k)
    for (std::int64_t j = 0; j < kDims[1]; ++j)
      for (std::int64_t i = 0; i < kDims[0]; ++i)
        out.memory[static_cast<std::size_t>(first + i * strides[0] + j * strides[1] + k * strides[2])] =
            static_cast<Sample>(field_at(i, j, k));
  out.view = view_of(out.memory.data() + first, kDims, {0.5, 0.75, 1}, {3, -4, 5});
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.view.strides[axis] = strides[axis] * static_cast<std::int64_t>(sizeof(Sample));
  return out;
}
template <class Sample>
Stored<Sample> x_fastest() {
  return stored<Sample>({1, 14, 14 * 16}, 0, 14 * 16 * 18);
}

void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_FALSE(a.triangles.empty());
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

std::string error_of(const std::function<void()>& call, Error::Kind kind = Error::Kind::kInput) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "no error";
}

TEST(Library, EveryOrderOfTheAxesGivesAProvenMeshInItsPlaceWithoutACopy) {
  const auto reference = x_fastest<float>();
  EXPECT_FALSE(mesh(reference.view, kIsovalue).report.copied_samples);
  std::array<std::size_t, 3> order = {0, 1, 2};
  int tried = 0;
  do {
    for (int flips = 0; flips < 8; ++flips) {
      std::array<std::int64_t, 3> strides{};
      std::int64_t stride = 1, first = 0;
      for (const std::size_t axis : order) {
        const bool is_turned = (flips >> axis & 1) != 0;
        strides[axis] = is_turned ? -stride : stride;
        if (is_turned) first += stride * (kDims[axis] - 1);
        stride *= kDims[axis];
      }
      const auto volume = stored<float>(strides, first, 14 * 16 * 18);
      const MeshResult result = mesh(volume.view, kIsovalue);
      EXPECT_TRUE(result.report.proven);
      EXPECT_FALSE(result.report.copied_samples);
      // The same samples in the usual order say where the mesh has to be, and how it has to face.
      EXPECT_TRUE(verify(result.mesh, reference.view, kIsovalue).proven);
      EXPECT_TRUE(verify(result.mesh, volume.view, kIsovalue).proven);
      ++tried;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(tried, 48);
}

TEST(Library, SamplesWithGapsAreCopied) {
  const auto packed = x_fastest<float>();
  const auto gaps = stored<float>({2, 40, 40 * 20}, 3, 40 * 20 * 18 + 40);
  const MeshResult result = mesh(gaps.view, kIsovalue);
  EXPECT_TRUE(result.report.copied_samples);
  expect_equal(result.mesh, mesh(packed.view, kIsovalue).mesh);
  // The same samples at an odd address.
  std::vector<char> bytes(packed.memory.size() * sizeof(float) + 1);
  std::copy_n(reinterpret_cast<const char*>(packed.memory.data()), bytes.size() - 1, bytes.data() + 1);
  VolumeView odd = packed.view;
  odd.samples = bytes.data() + 1;
  expect_equal(mesh(odd, kIsovalue).mesh, result.mesh);
}

template <class Sample>
void expect_same_as_doubles(bool is_copied) {
  const auto doubles = x_fastest<double>(), own = x_fastest<double>();
  const auto typed = x_fastest<Sample>();
  const MeshResult result = mesh(typed.view, kIsovalue);
  EXPECT_EQ(result.report.copied_samples, is_copied);
  expect_equal(result.mesh, mesh(doubles.view, kIsovalue).mesh);
}
TEST(Library, EveryTypeOfSampleGivesTheSameMesh) {
  expect_same_as_doubles<std::uint8_t>(false);
  expect_same_as_doubles<std::int8_t>(false);
  expect_same_as_doubles<std::uint16_t>(false);
  expect_same_as_doubles<std::int16_t>(false);
  expect_same_as_doubles<std::int32_t>(false);
  expect_same_as_doubles<float>(false);
  expect_same_as_doubles<std::uint32_t>(true);
  expect_same_as_doubles<std::uint64_t>(true);
  expect_same_as_doubles<std::int64_t>(true);
}

TEST(Library, HalvesAndTruthValuesAreSamples) {
  const auto truths = [] {
    auto all = x_fastest<std::uint8_t>();
    for (std::uint8_t& value : all.memory) value = value > 20 ? 1 : 0;
    return all;
  }();
  VolumeView as_bool = truths.view;
  as_bool.type = ScalarType::kBool;
  const MeshResult result = mesh(as_bool, 0.5);
  EXPECT_FALSE(result.report.copied_samples);
  expect_equal(result.mesh, mesh(truths.view, 0.5).mesh);
  // 1.0 as a half is 0x3C00.
  std::vector<std::uint16_t> halves;
  for (const std::uint8_t value : truths.memory) halves.push_back(value == 1 ? 0x3C00 : 0);
  VolumeView as_half = view_of(halves.data(), kDims);
  as_half.affine = truths.view.affine;
  as_half.type = ScalarType::kFloat16;
  expect_equal(mesh(as_half, 0.5).mesh, result.mesh);
}

TEST(Library, ARegionIsTheSameAsAPart) {
  // k fastest, so that the region's axes are not those of the memory.
  const auto volume = stored<std::int16_t>({16 * 18, 18, 1}, 0, 14 * 16 * 18);
  MeshOptions options;
  options.parameters.set("region.i0", 1).set("region.k0", 2).set("region.k1", 12);
  const MeshResult of_region = mesh(volume.view, kIsovalue, options);
  VolumeView part = volume.view;
  part.samples = volume.memory.data() + 16 * 18 + 2;
  part.dims = {13, 16, 11};
  part.affine[0][3] += 0.5;
  part.affine[2][3] += 2;
  expect_equal(of_region.mesh, mesh(part, kIsovalue).mesh);
  EXPECT_TRUE(of_region.report.proven);
  VerifyOptions as_meshed;
  as_meshed.parameters = options.parameters;
  EXPECT_TRUE(verify(of_region.mesh, volume.view, kIsovalue, as_meshed).proven);
  EXPECT_FALSE(verify(of_region.mesh, volume.view, kIsovalue).proven);
  EXPECT_NE(of_region.report.json.find("\"k1\": 12"), std::string::npos);
  options.parameters.set("region.k1", 18);
  EXPECT_EQ(error_of([&] { mesh(volume.view, kIsovalue, options); }),
            "region: along z the volume has the samples 0 to 17, expected at least two of them, found 2 to 18");
}

TEST(Library, ARotatedVolumeHasARotatedMesh) {
  auto volume = x_fastest<float>();
  volume.view.affine = {{{0.6, -0.8, 0, 10}, {0.8, 0.6, 0, 20}, {0, 0, -1, 30}}};  // it reflects, too
  const MeshResult result = mesh(volume.view, kIsovalue);
  EXPECT_TRUE(result.report.proven);
  EXPECT_TRUE(verify(result.mesh, volume.view, kIsovalue).proven);
  // The point of the isosurface nearest to the first ball's centre is above it in the samples' order, below in the
  // world.
  for (const auto& [x, y, z] : result.mesh.vertices) EXPECT_TRUE(30 - 17 <= z && z <= 30) << z;
}

TEST(Library, TheCallersRoundingDoesNotMatter) {
  const auto volume = x_fastest<float>();
  const Mesh usual = mesh(volume.view, kIsovalue).mesh;
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  const Mesh upward = mesh(volume.view, kIsovalue).mesh;
  EXPECT_EQ(std::fegetround(), FE_UPWARD) << "what the caller has set stays";
  std::fesetround(FE_TONEAREST);
  expect_equal(upward, usual);
}

TEST(Library, TwoMeshesAtOnceAreTheSameAsOneAfterTheOther) {
  const auto volume = x_fastest<float>(), other = stored<float>({16 * 18, 18, 1}, 0, 14 * 16 * 18);
  const MeshResult first = mesh(volume.view, kIsovalue), second = mesh(other.view, kIsovalue + 3);
  MeshOptions with_threads;
  with_threads.threads = 2;
  std::array<Mesh, 4> found;
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < 4; ++n) {
    threads.emplace_back([&, n] {
      const MeshOptions options = n < 2 ? MeshOptions() : with_threads;
      found[n] =
          n % 2 == 0 ? mesh(volume.view, kIsovalue, options).mesh : mesh(other.view, kIsovalue + 3, options).mesh;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t n = 0; n < 4; ++n) expect_equal(found[n], n % 2 == 0 ? first.mesh : second.mesh);
}

TEST(Library, TheCallbackIsToldAndCanStop) {
  const auto volume = x_fastest<float>();
  MeshOptions options;
  double last = 0;
  std::set<std::string> stages;
  options.progress = [&](const StageProgress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    stages.emplace(progress.stage);
    return true;
  };
  expect_equal(mesh(volume.view, kIsovalue, options).mesh, mesh(volume.view, kIsovalue).mesh);
  for (const char* stage : {"index", "initial", "recover", "refine", "certify"}) EXPECT_TRUE(stages.contains(stage));

  options.progress = [](const StageProgress& progress) { return progress.stage != "recover"; };
  const MeshResult partial = mesh(volume.view, kIsovalue, options);
  EXPECT_TRUE(partial.report.stopped);
  EXPECT_EQ(partial.report.stopped_in, "recover");
  EXPECT_FALSE(partial.report.unmet.empty());
  EXPECT_FALSE(partial.mesh.triangles.empty());

  options.progress = [](const StageProgress&) -> bool { throw std::out_of_range("mine"); };
  EXPECT_THROW(mesh(volume.view, kIsovalue, options), std::out_of_range);

  std::atomic<bool> stop = true;
  options.progress = {};
  options.stop = &stop;
  const MeshReport stopped = mesh(volume.view, kIsovalue, options).report;
  EXPECT_TRUE(stopped.stopped);
  ASSERT_FALSE(stopped.unmet.empty());
  EXPECT_NE(stopped.unmet[0].find("was stopped by the caller"), std::string::npos);

  VerifyOptions never;
  never.progress = [](const StageProgress&) { return false; };
  error_of([&] { verify(partial.mesh, volume.view, kIsovalue, never); }, Error::Kind::kStopped);
}

TEST(Library, MistakesAreToldInOneSentence) {
  auto volume = stored<float>({16 * 18, 18, 1}, 0, 14 * 16 * 18);  // k fastest
  EXPECT_EQ(error_of([] { ParameterSet().set("stage2.epsilon", 1); }).substr(0, 64),
            "parameters: unknown key 'stage2.epsilon', the nearest known key ");
  EXPECT_EQ(error_of([] { ParameterSet().set("boundary", "shut"); }),
            "parameters: boundary must be one of 'open', 'closed', found \"shut\"");
  EXPECT_EQ(error_of([] { ParameterSet().set("stage1.rho", 0.5); }),
            "parameters: stage1.rho must be a number >= 1, found 0.5");
  EXPECT_EQ(error_of([] { ParameterSet().set("stage1", 0.5); }),
            "parameters: 'stage1' is a group of keys, expected one of them");
  EXPECT_EQ(error_of([&] { mesh(volume.view, 1000); }).substr(0, 14), "isovalue 1000 ");
  volume.memory[(3 * 16 + 2) * 18 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(error_of([&] { mesh(volume.view, kIsovalue); }),
            "sample (3, 2, 1) is NaN: every sample must be a finite number");
  EXPECT_EQ(info(volume.view).nan, 1u);
  VolumeView flat = volume.view;
  flat.dims = {14, 1, 18};
  EXPECT_EQ(error_of([&] { mesh(flat, kIsovalue); }),
            "the volume's dimensions are 14 x 1 x 18: each must be at least 2");
  EXPECT_NE(error_of([] { info(VolumeView{}); }).find("no samples"), std::string::npos);
  Mesh wrong{{{0, 0, 0}, {1, 0, 0}, {0, 1, std::numeric_limits<double>::infinity()}}, {{0, 1, 2}}};
  EXPECT_EQ(error_of([&] { verify(wrong, x_fastest<float>().view, kIsovalue); }),
            "vertex 2 of the mesh is (0, 1, inf), expected finite numbers");
  std::vector<std::uint64_t> huge(14 * 16 * 18, 1);
  huge[5] = (std::uint64_t{1} << 60) + 1;
  EXPECT_EQ(error_of([&] { info(view_of(huge.data(), kDims)); }),
            "sample (5, 0, 0) is 1152921504606846977, which no double holds exactly: scale the samples, or store them "
            "as doubles");
}

TEST(Library, VerifyFindsWhatIsWrongWithAMesh) {
  const auto volume = x_fastest<float>();
  Mesh wrong = mesh(volume.view, kIsovalue).mesh;
  wrong.triangles.pop_back();
  const VerifyReport open = verify(wrong, volume.view, kIsovalue);
  EXPECT_FALSE(open.proven);
  EXPECT_FALSE(open.failures.empty());
  for (auto& [a, b, c] : wrong.triangles) std::swap(b, c);
  const VerifyReport reversed = verify(wrong, volume.view, kIsovalue);
  const auto orientation = std::find_if(reversed.checks.begin(), reversed.checks.end(),
                                        [](const auto& check) { return check.first == "orientation"; });
  ASSERT_NE(orientation, reversed.checks.end());
  EXPECT_FALSE(orientation->second);
}

TEST(Library, TheTopologyIsThatOfTheMesh) {
  const auto volume = x_fastest<float>();
  const TopologyReport exact = topology(volume.view, kIsovalue);
  const MeshReport report = mesh(volume.view, kIsovalue).report;
  EXPECT_EQ(exact.components, report.components);
  EXPECT_EQ(exact.euler_characteristic, report.euler_characteristic);
  EXPECT_EQ(exact.isosurface.size(), 1u);
  // Inside out and cut off by the box, as asked for.
  TopologyOptions closed;
  closed.parameters.set("boundary", "closed").set("field.invert", true);
  EXPECT_EQ(topology(volume.view, kIsovalue, closed).components, exact.components + 1);
}

TEST(Library, VerifyAcceptsTheNumberOfComponentsThatWereLeftOut) {
  auto volume = x_fastest<float>();
  volume.memory[2 + 14 * (2 + 16 * 15)] = 100;  // a grain apart from the balls
  MeshOptions options;
  options.parameters.set("components.keep_largest", 1);
  const MeshResult result = mesh(volume.view, kIsovalue, options);
  EXPECT_TRUE(result.report.proven);
  EXPECT_EQ(result.report.dropped_components, 1);
  EXPECT_NE(result.report.json.find("\"dropped_components\": 1"), std::string::npos);
  VerifyOptions verified;
  EXPECT_FALSE(verify(result.mesh, volume.view, kIsovalue, verified).proven);
  verified.dropped_components = result.report.dropped_components;
  EXPECT_TRUE(verify(result.mesh, volume.view, kIsovalue, verified).proven);
}

TEST(Library, ParametersAreThoseOfTheTable) {
  const std::vector<ParameterInfo> all = parameters();
  EXPECT_GT(all.size(), 40u);
  for (const ParameterInfo& parameter : all) {
    EXPECT_FALSE(parameter.effect.empty()) << parameter.name;
    EXPECT_FALSE(parameter.allowed.empty()) << parameter.name;
  }
  EXPECT_EQ(all.front().name, "algorithm");
  EXPECT_EQ(all.front().default_value, "\"two_stage\"");
}

TEST(Library, FilesKeepVolumesAndMeshes) {
  const TemporaryFolder folder;
  const auto volume = x_fastest<float>();
  const Mesh made = mesh(volume.view, kIsovalue).mesh;
  save_mesh(made, folder / "mesh.ply");
  expect_equal(load_mesh(folder / "mesh.ply"), made);
  Mesh cut = made;
  cut.vertices.resize(3);
  cut.triangles = {{0, 1, 2}, {0, 1, 3}};
  for (const char* ending : {".glb", ".mesh", ".msh", ".stl", ".ply", ".off", ".obj", ".vtk", ".vtp", ".smesh"}) {
    const std::filesystem::path path = folder / (std::string("cut") + ending);
    EXPECT_NE(error_of([&] { save_mesh(cut, path); }).find("triangle 1 of the mesh names a vertex that is not there"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_NE(error_of([&] { save_mesh(made, folder / "mesh.txt"); }).find("mesh.txt"), std::string::npos);
  EXPECT_NE(error_of([&] { load_volume(folder / "none.nrrd"); }).find("none.nrrd"), std::string::npos);
}

TEST(Library, VersionsAgree) {
  EXPECT_EQ(version(), DELISO_VERSION_TEXT);
  const auto text_of = [](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(std::filesystem::path(DELISO_SOURCE_DIR) / name).rdbuf();
    return text.str();
  };
  EXPECT_NE(text_of("CHANGELOG.md").find("\n## [" + version() + "]"), std::string::npos);
  EXPECT_NE(text_of("CITATION.cff").find("\nversion: " + version() + "\n"), std::string::npos);
}

}  // namespace
}  // namespace deliso::testing
