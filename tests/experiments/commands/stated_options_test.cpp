// An option and --set that state one parameter, and two of --set.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/json.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

using Arguments = std::vector<std::string>;

// All of this is found before the volume is looked for.
ProgramResult mesh(const Arguments& more) {
  Arguments arguments = {"mesh", "no.nrrd", "--isovalue", "0.5", "-o", "x.ply"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_deliso(arguments);
}

bool is_of_the_volume(const ProgramResult& result) { return result.err.find("no.nrrd") != std::string::npos; }

struct Pair {
  Arguments option;
  std::string key, same, other;
};

const std::vector<Pair>& pairs() {
  static const std::vector<Pair> all = {
      {{"--closed"}, "boundary", "closed", "open"},
      {{"--label", "5"}, "field.label", "5", "-7"},
      {{"--label", "5,6"}, "field.label", "null", "5"},
      {{"--smooth", "1.5"}, "field.smooth", "1.50", "2"},
      {{"--smooth", "0"}, "field.smooth", "null", "2"},
      {{"--invert"}, "field.invert", "true", "false"},
      {{"--max-error", "0.5"}, "size.max_error", ".5", "0.25"},
      {{"--max-edge", "2"}, "size.max_edge", "2", "null"},
      {{"--min-angle", "20"}, "size.min_angle", "20", "25"},
      {{"--max-aspect", "5"}, "size.max_aspect", "5.0", "6"},
      {{"--target-vertices", "300"}, "size.target_vertices", "3e2", "301"},
      {{"--keep-largest", "1"}, "components.keep_largest", "1", "2"},
      {{"--min-component", "50"}, "components.min_vertices", "50", "5"},
      {{"--min-component", "area:2.5"}, "components.min_area", "2.5", "3"},
      {{"--min-component", "volume:10"}, "components.min_volume", "10", "3"},
      {{"--fill-cavities"}, "components.fill_cavities", "true", "false"},
      {{"--region", "1:5,2:6,3:7"}, "region.i0", "1", "0"},
      {{"--region", "1:5,2:6,3:7"}, "region.k1", "7", "8"},
  };
  return all;
}

TEST(StatedOptions, AnOptionAndSetThatDisagreeAreRefused) {
  for (const Pair& pair : pairs()) {
    const std::string typed = pair.option.front() + (pair.option.size() > 1 ? " " + pair.option.back() : "");
    SCOPED_TRACE(typed);
    Arguments arguments = pair.option;
    arguments.insert(arguments.end(), {"--set", pair.key + "=" + pair.other});
    const ProgramResult refused = mesh(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err, "deliso: " + typed + ": states another " + pair.key + " than --set " + pair.key + "=" +
                               pair.other + ", expected one value; leave one of the two out\n");
    arguments.back() = pair.key + "=" + pair.same;
    const ProgramResult taken = mesh(arguments);
    EXPECT_TRUE(is_of_the_volume(taken)) << taken.err;
  }
}

TEST(StatedOptions, AssignmentsThatDisagreeAreRefused) {
  const std::string expected =
      "deliso: --set certify=true: states another certify than --set certify=false, expected one value; leave one of "
      "the two out\n";
  EXPECT_EQ(mesh({"--set", "certify=false", "--set", "stage1.rho=3", "--set", "certify=true"}).err, expected);
  EXPECT_EQ(run_deliso({"explain", "-o", "x.html", "--set", "certify=false", "--set", "certify=true"}).err, expected);
  EXPECT_TRUE(is_of_the_volume(mesh({"--set", "stage1.rho=3", "--set", "stage1.rho=3.0"})));
}

TEST(StatedOptions, AnOptionTakesTheNumbersThatSetTakes) {
  for (const std::string number : {"+5", ".5e1", "5.", "5"}) {
    const ProgramResult taken = mesh({"--max-aspect", number, "--set", "size.max_aspect=" + number});
    EXPECT_TRUE(is_of_the_volume(taken)) << taken.err;
  }
  const auto expect_refused = [](const std::string& option, const std::string& expected) {
    for (const std::string text : {"inf", "-inf", "nan", "1e999", "some", "3,5"}) {
      EXPECT_EQ(mesh({option, text}).err, "deliso: " + option + ": " + expected + " or null, found \"" + text + "\"\n");
    }
  };
  const std::string large = " and <= 9007199254740992";
  expect_refused("--max-aspect", "size.max_aspect must be a number >= 3");
  expect_refused("--min-angle", "size.min_angle must be a number > 0 and <= 35");
  expect_refused("--target-vertices", "size.target_vertices must be an integer >= 4" + large);
  expect_refused("--keep-largest", "components.keep_largest must be an integer >= 1" + large);
}

// What a file says is there to be replaced.
TEST(StatedOptions, OptionsAndAssignmentsReplaceWhatAFileSays) {
  const TemporaryFolder folder;
  write_file(folder / "p.json", R"({"field": {"label": 3}, "boundary": "closed"})");
  const ProgramResult taken = mesh({"--config", folder / "p.json", "--label", "5", "--set", "boundary=open"});
  EXPECT_TRUE(is_of_the_volume(taken)) << taken.err;
}

// Samples 0.57 mm apart, of a ball.
class StatedLengths : public ::testing::Test {
 protected:
  StatedLengths() {
    std::string bytes =
        "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nencoding: raw\nspace dimension: 3\n"
        "space units: \"mm\" \"mm\" \"mm\"\nspace directions: (0.57,0,0) (0,0.57,0) (0,0,0.57)\n"
        "space origin: (0,0,0)\n\n";
    for (int k = 0; k < 8; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i)
          bytes += static_cast<char>(std::lround(200 - 40 * std::hypot(i - 3.4, j - 3.6, k - 3.3)));
      }
    }
    write_file(folder_ / "v.nrrd", bytes);
  }
  ProgramResult mesh(const Arguments& more) {
    Arguments arguments = {"mesh", folder_ / "v.nrrd", "--isovalue", "99.5",
                           "-o",   folder_ / "m.ply",  "--report",   folder_ / "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(StatedLengths, AreComparedInVoxels) {
  for (const auto& [value, exit_code] :
       {std::pair<std::string, int>{"0.15", 0}, {"0.0855w", 0}, {"0.0855", 2}, {"0.0856mm", 2}}) {
    const ProgramResult result = mesh({"--max-error", "0.0855mm", "--set", "size.max_error=" + value});
    EXPECT_EQ(result.exit_code, exit_code) << value << ": " << result.err;
  }
}

// Not 0.15000000000000002, which is the quotient of the two rounded numbers.
TEST_F(StatedLengths, AreReportedAsStated) {
  for (const Arguments& stated : {Arguments{"--max-error", "0.0855mm"}, {"--set", "promise.max_distance=0.0855w"}}) {
    ASSERT_EQ(mesh(stated).exit_code, 0);
    const Json report = Json::parse(read_file(folder_ / "r.json"));
    EXPECT_EQ(report["promised_distance_voxels"], 0.15);
  }
}

// Whether they are long enough is known with the volume.
TEST_F(StatedLengths, ThatAreTooShortInVoxelsAreRefused) {
  const std::string edge = "deliso: --max-edge: expected a length of 0.001 voxels or more, found '";
  EXPECT_EQ(mesh({"--max-edge", "5e-324"}).err, edge + "5e-324', which is 5e-324 voxels\n");
  EXPECT_EQ(mesh({"--max-edge", "0.000057mm"}).err, edge + "0.000057mm', which is 1e-04 voxels\n");
  EXPECT_EQ(mesh({"--set", "size.max_edge=1e-4"}).err,
            "deliso: --set size.max_edge=1e-4: size.max_edge must be a number >= 0.001 or null, found 0.0001\n");
  std::string bytes = read_file(folder_ / "v.nrrd");
  for (std::size_t at = bytes.find("0.57"); at != std::string::npos; at = bytes.find("0.57"))
    bytes.replace(at, 4, "1e-9");
  write_file(folder_ / "v.nrrd", bytes);
  for (const Arguments& stated : {Arguments{"--max-edge", "1e-9mm"},
                                  {"--max-error", "1e-9mm"},
                                  {"--set", "size.max_edge=1e-9w"},
                                  {"--set", "promise.max_distance=1e-9mm"}}) {
    const ProgramResult taken = mesh(stated);
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
  }
}

TEST_F(StatedLengths, ThatNoDoubleHoldsInVoxelsAreRefused) {
  const ProgramResult refused = mesh({"--max-error", "1.7e308mm"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--max-error: expected a finite number"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace deliso::testing
