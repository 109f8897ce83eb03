// What the library says of its meshes, and what their files keep of it: stopped runs, sheared maps, labels, copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "surface/library/deliso/deliso.h"
#include "tests/support/temporary_folder.h"

namespace deliso::testing {
namespace {

// A wavy ball, whose first meshes are voxels away from it.
struct WavyBall {
  static constexpr int kSide = 40;
  std::vector<float> samples;
  VolumeView view;

  WavyBall() {
    for (int k = 0; k < kSide; ++k)
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
          samples.push_back(
              static_cast<float>(15.2 - std::hypot(i - 19.3, j - 19.6, k - 19.1) + std::sin(i) + std::cos(j)));
    view = view_of(samples.data(), {kSide, kSide, kSide});
  }
};

// Two balls apart, of whole numbers; the second is the smaller one.
struct TwoBalls {
  static constexpr std::array<std::int64_t, 3> kSides = {20, 14, 13};
  std::vector<std::uint8_t> samples;
  VolumeView view;

  TwoBalls() {
    for (int k = 0; k < kSides[2]; ++k)
      for (int j = 0; j < kSides[1]; ++j)
        for (int i = 0; i < kSides[0]; ++i) {
          const double a = 4.6 - std::hypot(i - 6.2, j - 6.3, k - 6.1),
                       b = 2.7 - std::hypot(i - 15.4, j - 6.6, k - 6.4);
          samples.push_back(static_cast<std::uint8_t>(std::clamp(100 + 20 * std::max(a, b), 0.0, 255.0)));
        }
    view = view_of(samples.data(), kSides);
  }
};

bool has(const std::vector<std::string>& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kInput) << error.what();
    return error.what();
  }
  return "no error";
}

TEST(Reports, ARunThatWasStoppedIsNotProven) {
  const WavyBall ball;
  for (const int most : {60, 150, 400}) {
    MeshOptions options;
    options.parameters.set("budget.max_vertices", most).set("size.max_error", 0.05);
    const MeshResult result = mesh(ball.view, 0, options);
    EXPECT_TRUE(result.report.stopped);
    EXPECT_FALSE(result.report.proven);
    ASSERT_FALSE(result.report.not_kept.empty());
    EXPECT_NE(result.report.not_kept.back().find("the run was stopped before"), std::string::npos);
    EXPECT_NE(result.report.json.find("\"proven\": false"), std::string::npos);
    EXPECT_NE(result.report.json.find("\"promised_distance_voxels\": null"), std::string::npos);
    for (const std::string& line : result.mesh.comments) EXPECT_FALSE(line.starts_with("promise")) << line;
  }
  MeshOptions options;
  options.progress = [](const StageProgress& told) { return told.stage != "refine"; };
  const MeshReport by_callback = mesh(ball.view, 0, options).report;
  EXPECT_TRUE(by_callback.stopped);
  EXPECT_FALSE(by_callback.proven);
  // What comes too late stops nothing.
  options.progress = [](const StageProgress& told) { return told.stage != "certify"; };
  const MeshReport late = mesh(ball.view, 0, options).report;
  EXPECT_FALSE(late.stopped);
  EXPECT_TRUE(late.proven);
}

TEST(Reports, AnglesAreThoseBeforeAShear) {
  WavyBall ball;
  ball.view.affine = {{{1, 3, 0, 2}, {0, 1, 0, 1}, {0, 0, 1, 0}}};
  const MeshResult result = mesh(ball.view, 0);
  const VerifyReport verified = verify(result.mesh, ball.view, 0);
  EXPECT_NEAR(result.report.min_angle_degrees, verified.min_angle_degrees, 1e-6);
  EXPECT_NEAR(result.report.max_angle_degrees, verified.max_angle_degrees, 1e-6);
}

TEST(Reports, TheWorstDistanceOfTrianglesWithoutAreaIsMeasured) {
  const TwoBalls balls;
  const Mesh whole = mesh(balls.view, 100.5).mesh;
  int far = 0;
  for (std::size_t v = 1; v < std::min<std::size_t>(60, whole.vertices.size()); ++v) {
    const Mesh line{{whole.vertices[0], whole.vertices[v]}, {{0, 0, 1}}};
    const VerifyReport verified = verify(line, balls.view, 100.5);
    const bool is_far = std::any_of(verified.failures.begin(), verified.failures.end(), [](const std::string& failure) {
      return failure.find("of the mesh are more than 1 voxel off") != std::string::npos;
    });
    if (!is_far) continue;
    ++far;
    EXPECT_GT(verified.mesh_to_isosurface, 1) << v;
  }
  EXPECT_GE(far, 5);
}

TEST(Reports, MeshesSayWhatAVerificationHasToKnow) {
  const TwoBalls balls;
  MeshOptions options;
  options.parameters.set("components.keep_largest", 1).set("region.i1", 18);
  options.parameters.set("promise.max_distance", 0.75).set("boundary", "closed").set("field.smooth", 0.5);
  const MeshResult result = mesh(balls.view, 100.5, options);
  EXPECT_TRUE(result.report.proven);
  const TemporaryFolder folder;
  for (const char* const name : {"m.ply", "m.off", "m.stl", "m.vtk"}) {
    save_mesh(result.mesh, folder / name);
    const std::vector<std::string> found = load_mesh(folder / name).comments;
    for (const char* const line : {"promise.max_distance 0.75", "boundary closed", "field.smooth 0.5"}) {
      EXPECT_TRUE(has(found, line)) << name << ": " << line;
    }
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const auto& line) { return line.starts_with("region "); }));
  }
  EXPECT_EQ(result.report.dropped_components, 1);
  EXPECT_TRUE(has(result.mesh.comments, "components dropped 1"));
  MeshOptions inverted;
  inverted.parameters.set("field.invert", true);
  EXPECT_TRUE(has(mesh(balls.view, 100.5, inverted).mesh.comments, "field.invert true"));
  // A comment is a line, whatever is in it.
  Mesh noted = result.mesh;
  noted.comments = {"one\nend_header"};
  save_mesh(noted, folder / "n.ply");
  const Mesh read = load_mesh(folder / "n.ply");
  EXPECT_TRUE(has(read.comments, "one?end_header"));
  // Read and written again, a file says nothing twice.
  save_mesh(read, folder / "again.ply");
  EXPECT_EQ(load_mesh(folder / "again.ply").comments, read.comments);
}

TEST(Reports, TheSurfaceOfALabelHasOneIsovalue) {
  std::vector<std::uint8_t> samples(6 * 6 * 6, 0);
  samples[2 + 6 * (2 + 6 * 2)] = samples[3 + 6 * (2 + 6 * 2)] = 1;
  const VolumeView view = view_of(samples.data(), {6, 6, 6});
  MeshOptions options;
  options.parameters.set("field.label", 1);
  VerifyOptions to_verify;
  TopologyOptions of_topology;
  to_verify.parameters = of_topology.parameters = options.parameters;
  for (const double given : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const MeshResult result = mesh(view, given, options);
    EXPECT_TRUE(result.report.proven);
    EXPECT_NE(result.report.json.find("\"isovalue\": 0.5,"), std::string::npos);
    EXPECT_TRUE(has(result.mesh.comments, "field.label 1"));
    EXPECT_TRUE(verify(result.mesh, view, given, to_verify).proven);
  }
  const std::string expected =
      "isovalue: the surface of a label lies half-way between it and all others, found 77 beside field.label, "
      "expected 0.5";
  EXPECT_EQ(refusal_of([&] { mesh(view, 77, options); }), expected);
  EXPECT_EQ(refusal_of([&] { verify({}, view, 77, to_verify); }), expected);
  EXPECT_EQ(refusal_of([&] { topology(view, 77, of_topology); }), expected);
}

TEST(Reports, NamedIsovaluesAreThoseOfTheRegion) {
  TwoBalls balls;
  balls.samples.front() = 255;  // outside the region
  ParameterSet region;
  region.set("region.i0", 10).set("region.k1", 9);
  const auto index = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::size_t>(i + 20 * (j + 14 * k));
  };
  double low = 255, high = 0;
  for (std::int64_t k = 0; k <= 9; ++k)
    for (std::int64_t j = 0; j < 14; ++j)
      for (std::int64_t i = 10; i < 20; ++i) {
        low = std::min<double>(low, balls.samples[index(i, j, k)]);
        high = std::max<double>(high, balls.samples[index(i, j, k)]);
      }
  EXPECT_EQ(named_isovalue(balls.view, "50%", region), 0.5 * low + 0.5 * high);
  EXPECT_NE(named_isovalue(balls.view, "50%"), named_isovalue(balls.view, "50%", region));
  EXPECT_EQ(named_isovalue(balls.view, "otsu"), info(balls.view).otsu);
  EXPECT_EQ(refusal_of([&] { named_isovalue(balls.view, "most"); }),
            "isovalue: expected a number, 'otsu', 'mean', 'median' or 'P%', found 'most'");
  EXPECT_EQ(refusal_of([&] { named_isovalue(balls.view, "0%"); }),
            "isovalue: expected a share of the range above 0% and below 100%, found '0%'");
}

TEST(Reports, NewFieldsAreToldOfAsCopies) {
  const TwoBalls balls;
  for (const auto& [name, value] : std::vector<std::pair<std::string, ParameterInput>>{
           {"boundary", "closed"}, {"field.smooth", 1.0}, {"field.label", std::int64_t{100}}}) {
    MeshOptions options;
    options.parameters.set(name, value);
    EXPECT_TRUE(mesh(balls.view, name == "field.label" ? 0.5 : 100.5, options).report.copied_samples) << name;
  }
}

TEST(Reports, MistakesNameWhatWasFound) {
  const TwoBalls balls;
  for (const auto& [value, shown] : {std::pair(-1.0, "-1"), std::pair(std::nan(""), "nan")}) {
    VerifyOptions options;
    options.max_distance = value;
    EXPECT_EQ(refusal_of([&] { verify({}, balls.view, 100.5, options); }),
              std::string("max_distance: expected a number >= 0, found ") + shown);
  }
  EXPECT_EQ(refusal_of([] { ParameterSet().set("boundary", static_cast<const char*>(nullptr)); }),
            "parameters: boundary must be one of 'open', 'closed', found null");
  EXPECT_EQ(refusal_of([&] {
              view_of(balls.samples.data(), TwoBalls::kSides, {1, -1, 1});
            }),
            "spacing: expected three lengths > 0, found -1; an affine map may turn axes the other way round");
  const std::string cut("a\0b.ply", 7);
  for (const auto& call : std::vector<std::function<void()>>{[&] { save_mesh({}, cut); }, [&] { load_mesh(cut); },
                                                             [&] { load_volume(cut); }}) {
    EXPECT_EQ(refusal_of(call), "path: expected a file name, found 'a' followed by a null character");
  }
}

}  // namespace
}  // namespace deliso::testing
