// deliso render as a user runs it: the file it writes, and what it refuses.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "experiments/pictures/image.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// The picture in the bytes of a PNG file, read with libpng.
Image decoded(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0) << header.message;
  header.format = PNG_FORMAT_RGB;
  Image image(static_cast<std::int32_t>(header.width), static_cast<std::int32_t>(header.height));
  EXPECT_NE(png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr), 0) << header.message;
  return image;
}

class Render : public ::testing::Test {
 protected:
  Render() {
    EXPECT_EQ(run_deliso({"generate", "shells", "--size", "20", "-o", folder_ / "v.nrrd"}).exit_code, 0);
    names_ = folder_.names();
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", folder_ / "v.nrrd", "--isovalue", "100.5"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_deliso(arguments);
  }
  // Draws into p.png.
  [[nodiscard]] Image picture(std::vector<std::string> options) const {
    options.insert(options.end(), {"-o", folder_ / "p.png"});
    const ProgramResult result = run(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return decoded(read_file(folder_ / "p.png"));
  }
  void expect_refusal(const std::vector<std::string>& options, const std::vector<std::string>& parts) const {
    const ProgramResult result = run(options);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& part : parts) {
      EXPECT_NE(result.err.find(part), std::string::npos) << part << " in " << result.err;
    }
    EXPECT_EQ(folder_.names(), names_);
  }
  // An option with a bad value; the rest is good.
  void expect_bad(const std::string& option, const std::string& value, const std::vector<std::string>& parts) const {
    SCOPED_TRACE(option + " " + value);
    expect_refusal({"-o", folder_ / "p.png", option, value}, parts);
  }

  TemporaryFolder folder_;
  std::vector<std::string> names_;
};

// Pixels that are not white in the columns from `first` to before `last`.
std::ptrdiff_t drawn(const Image& image, std::int32_t first, std::int32_t last) {
  std::ptrdiff_t count = 0;
  for (std::int32_t y = 0; y < image.height; ++y) {
    for (std::int32_t x = first; x < last; ++x) count += image.pixel(x, y)[2] < 255 ? 1 : 0;
  }
  return count;
}

TEST_F(Render, WritesAPictureOfTheSizeAskedFor) {
  const Image image = picture({"--size", "61x47", "--samples", "2"});
  EXPECT_EQ(image.width, 61);
  EXPECT_EQ(image.height, 47);
  EXPECT_GT(drawn(image, 0, 61), 61 * 47 / 4);
  EXPECT_EQ(picture({"--samples", "1"}).width, 800);
}

TEST_F(Render, EqualRunsGiveEqualBytes) {
  std::string first;
  for (const std::string threads : {"1", "2", "1"}) {
    (void)picture({"--size", "80x40", "--marching-cubes", "--surface", "--threads", threads});
    if (first.empty()) first = read_file(folder_ / "p.png");
    EXPECT_EQ(read_file(folder_ / "p.png"), first);
  }
}

TEST_F(Render, ShowsSurfaceMarchingCubesAndMeshesSideBySide) {
  ASSERT_EQ(run_deliso({"mesh", folder_ / "v.nrrd", "--isovalue", "100.5", "-o", folder_ / "m.ply"}).exit_code, 0);
  const Image image = picture({"--surface", "--marching-cubes", "--mesh", folder_ / "m.ply", "--size", "240x80"});
  // All show the same body: as much of each third is drawn, the surface without lines and so with fewer dark pixels.
  const std::array<std::ptrdiff_t, 3> thirds{drawn(image, 0, 80), drawn(image, 80, 160), drawn(image, 160, 240)};
  for (const std::ptrdiff_t third : thirds) {
    EXPECT_GT(third, 1000);
    EXPECT_NEAR(static_cast<double>(third), static_cast<double>(thirds[0]), 0.05 * static_cast<double>(thirds[0]));
  }
  const auto mean = [&](std::int32_t first) {
    int sum = 0;
    for (std::int32_t y = 25; y < 55; ++y) {
      for (std::int32_t x = first + 25; x < first + 55; ++x) sum += image.pixel(x, y)[0];
    }
    return sum / 900;
  };
  EXPECT_GT(mean(0), mean(80) + 3);
  EXPECT_GT(mean(0), mean(160) + 3);
  const ProgramResult result = run({"--marching-cubes", "-o", folder_ / "p.png", "--size", "9x9"});
  EXPECT_NE(result.out.find(" vertices, "), std::string::npos) << result.out;
}

TEST_F(Render, CutsViewAndZoomChangeWhatIsSeen) {
  const Image plain = picture({"--size", "40x40"});
  EXPECT_NE(picture({"--size", "40x40", "--clip", "x=9.5"}).rgb, plain.rgb);
  EXPECT_NE(picture({"--size", "40x40", "--view", "120,-40"}).rgb, plain.rgb);
  EXPECT_NE(picture({"--size", "40x40", "--perspective", "40"}).rgb, plain.rgb);
  EXPECT_EQ(picture({"--size", "40x40", "--clip", "x=1000"}).rgb, plain.rgb);
  EXPECT_LT(4 * drawn(picture({"--size", "40x40", "--zoom", "0.25"}), 0, 40), drawn(plain, 0, 40));
  // An empty picture is told.
  const ProgramResult far_off = run({"--size", "40x40", "--look-at", "500,500,500", "-o", folder_ / "p.png"});
  EXPECT_EQ(far_off.exit_code, 0);
  EXPECT_EQ(far_off.err, "deliso: isosurface: nothing of it is in the picture, expected another --look-at, --view, " +
                             std::string("--zoom or --clip\n"));
  EXPECT_EQ(drawn(decoded(read_file(folder_ / "p.png")), 0, 40), 0);
}

TEST_F(Render, RefusesWhatCannotBeDone) {
  expect_bad("--clip", "w=3", {"--clip", "x=V", "w=3"});
  expect_bad("--clip", "x", {"--clip", "'x'"});
  expect_bad("--clip", "x=abc", {"--clip", "abc"});
  expect_bad("--clip", "x=-5", {"--clip", "x=-5", "0 to 19"});
  expect_bad("--size", "0x10", {"--size", "'0'"});
  expect_bad("--size", "10x0", {"--size", "'0'"});
  expect_bad("--size", "10", {"--size", "'10'"});
  expect_bad("--size", "10x10x10", {"--size"});
  expect_bad("--size", "16000x16000", {"--size", "rays"});
  expect_bad("--samples", "0", {"--samples", "1 to 8"});
  expect_bad("--view", "30", {"--view", "'30'"});
  expect_bad("--view", "30,91", {"--view", "90", "91"});
  expect_bad("--zoom", "0", {"--zoom", "'0'"});
  expect_bad("--perspective", "180", {"--perspective", "150"});
  expect_bad("--look-at", "1,2", {"--look-at", "1,2"});
  expect_bad("--line-width", "-1", {"--line-width", "-1"});
  expect_bad("--threads", "0", {"--threads"});
  expect_bad("--mesh", folder_ / "none.ply", {"none.ply"});
}

TEST_F(Render, RefusesPlacesWhereNoPictureCanBe) {
  expect_refusal({"-o", folder_ / "p.jpg"}, {"-o", "p.jpg", ".png"});
  expect_refusal({"-o", folder_ / "png"}, {".png"});
  expect_refusal({"-o", folder_ / "none/p.png"}, {"-o", "none/p.png"});
  expect_refusal({"-o", "/proc/p.png"}, {"-o", "/proc/p.png"});
  const ProgramResult outside =
      run_deliso({"render", folder_ / "v.nrrd", "--isovalue", "1e9", "-o", folder_ / "p.png"});
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_NE(outside.err.find("range"), std::string::npos) << outside.err;
  EXPECT_EQ(folder_.names(), names_);
}

// A ball of 16^3 samples that lies turned about z in the world, 100 to 300 away from its origin.
class RenderInTheWorld : public ::testing::Test {
 protected:
  RenderInTheWorld() {
    std::string bytes =
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 16 16 16\nencoding: raw\n"
        "space: left-posterior-superior\nspace directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,1)\n"
        "space origin: (100,200,300)\n\n";
    for (int n = 0; n < 16 * 16 * 16; ++n) {
      const int i = n % 16, j = n / 16 % 16, k = n / 256;
      const double r = std::hypot(i - 7.3, j - 7.4, k - 7.6);
      bytes += static_cast<char>(std::lround(150 - 10 * r));
    }
    write_file(volume_, bytes);
  }
  // The picture beside its messages.
  [[nodiscard]] std::pair<Image, std::string> picture(std::vector<std::string> options) const {
    options.insert(options.begin(),
                   {"render", volume_, "--isovalue", "99.5", "-o", folder_ / "p.png", "--samples", "1"});
    const ProgramResult result = run_deliso(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return {decoded(read_file(folder_ / "p.png")), result.err};
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd";
};

TEST_F(RenderInTheWorld, MeshesOfEverySpaceAndOriginLieOnTheIsosurface) {
  const std::vector<std::vector<std::string>> places = {{"a.ply"},
                                                        {"b.ply", "--space", "RAS"},
                                                        {"c.stl", "--local-origin"},
                                                        {"d.obj", "--space", "RAS", "--local-origin"}};
  std::vector<std::string> options = {"--surface", "--size", "250x50"};
  for (const std::vector<std::string>& place : places) {
    const std::string path = folder_ / place.front();
    std::vector<std::string> arguments = {"mesh", volume_, "--isovalue", "99.5", "-o", path};
    arguments.insert(arguments.end(), place.begin() + 1, place.end());
    ASSERT_EQ(run_deliso(arguments).exit_code, 0);
    options.insert(options.end(), {"--mesh", path});
  }
  const auto [image, remarks] = picture(options);
  EXPECT_EQ(remarks, "");
  const auto surface = static_cast<double>(drawn(image, 0, 50));
  EXPECT_GT(surface, 1000);
  for (std::int32_t left = 50; left < 250; left += 50)
    EXPECT_NEAR(static_cast<double>(drawn(image, left, left + 50)), surface, 0.05 * surface) << left;
  // What is typed comes before what the file says; a mesh that is not seen is named.
  const auto [blank, remark] = picture({"--mesh", folder_ / "b.ply", "--space", "native", "--size", "50x50"});
  EXPECT_EQ(drawn(blank, 0, 50), 0);
  EXPECT_NE(remark.find("b.ply lies outside"), std::string::npos) << remark;
  const ProgramResult alone =
      run_deliso({"render", volume_, "--isovalue", "99.5", "-o", folder_ / "p.png", "--space", "RAS"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("expected --mesh"), std::string::npos) << alone.err;
}

// The middle of the ball is at (101.4, 210.3, 307.6).
TEST_F(RenderInTheWorld, CutsAndLooksAtPlacesOfTheWorld) {
  const auto seen = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--size", "50x50", "--view", "90,0"});
    return drawn(picture(options).first, 0, 50);
  };
  const std::ptrdiff_t whole = seen({});
  EXPECT_GT(whole, 1000);
  // From the side of y the eye sees half of what is cut at the middle along x.
  EXPECT_NEAR(static_cast<double>(seen({"--clip", "x=101.4"})), 0.5 * static_cast<double>(whole), 60);
  EXPECT_NEAR(static_cast<double>(seen({"--look-at", "101.4,210.3,307.6"})), static_cast<double>(whole), 60);
  EXPECT_EQ(seen({"--look-at", "301.4,210.3,307.6"}), 0);
  const ProgramResult nothing =
      run_deliso({"render", volume_, "--isovalue", "99.5", "-o", folder_ / "p.png", "--clip", "x=50"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("x goes from 91 to 112"), std::string::npos) << nothing.err;
}

}  // namespace
}  // namespace deliso::testing
