// Binary STL files tell of themselves in 80 letters: whatever options a mesh was made with, `verify` needs none of them
// again, or `mesh` says which.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/commands/mesh_output.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

constexpr std::size_t kLetters = 80;

using Arguments = std::vector<std::string>;

Arguments joined_arguments(Arguments first, const Arguments& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

// Two balls, the larger one cut off by the box, of samples whose axes are turned and whose space is LPS.
template <class Sample, class Value>
std::string two_balls(const std::string& type, Value value) {
  constexpr int kNx = 20, kNy = 11, kNz = 10;
  std::string bytes = "NRRD0005\ntype: " + type +
                      "\ndimension: 3\nsizes: 20 11 10\nencoding: raw\nendian: little\nspace: LPS\n"
                      "space directions: (0,-1,0) (0.5,0,0) (0,0,-1.5)\nspace origin: (10,20,30)\n\n";
  for (int k = 0; k < kNz; ++k) {
    for (int j = 0; j < kNy; ++j) {
      for (int i = 0; i < kNx; ++i) {
        const double large = 4.1 - std::hypot(i - 2.3, j - 5.4, k - 4.6);
        const double small = 2.2 - std::hypot(i - 14.4, j - 5.2, k - 4.7);
        const auto sample = static_cast<Sample>(value(std::fmax(large, small)));
        bytes.append(sizeof sample, '\0');
        std::memcpy(bytes.data() + bytes.size() - sizeof sample, &sample, sizeof sample);
      }
    }
  }
  return bytes;
}

class StlHeader : public ::testing::Test {
 protected:
  StlHeader() {
    write_file(folder_ / "field.nrrd", two_balls<float>("float", [](double d) { return d; }));
    write_file(folder_ / "nan.nrrd", two_balls<float>("float", [](double d) {
                 return d > 3 ? std::numeric_limits<double>::quiet_NaN() : d;
               }));
    write_file(folder_ / "labels.nrrd", two_balls<std::int16_t>("int16", [](double d) { return d > 0 ? 2 : 0; }));
    write_file(folder_ / "low.nrrd",
               two_balls<std::int32_t>("int32", [](double d) { return d > 0 ? -2147483647 : 0; }));
  }
  ProgramResult mesh(const std::string& volume, const Arguments& options) {
    return run_deliso(joined_arguments({"mesh", folder_ / volume, "-o", mesh_}, options));
  }
  ProgramResult verify(const std::string& volume, const Arguments& options, const std::string& path) {
    return run_deliso(joined_arguments({"verify", path, folder_ / volume}, options));
  }
  // The isovalue is an option of every verification but that of a label.
  static Arguments isovalue_of(const std::string& volume) {
    return volume == "labels.nrrd" || volume == "low.nrrd" ? Arguments{} : Arguments{"--isovalue", "0.0123"};
  }
  [[nodiscard]] std::string header() const { return read_file(mesh_).substr(0, kLetters); }

  TemporaryFolder folder_;
  std::string mesh_ = folder_ / "m.stl";
};

struct HeaderCase {
  std::string volume;
  Arguments options;
  bool is_needed = true;  // whether a file that says nothing fails
};

TEST_F(StlHeader, VerifyNeedsNoOptionTwice) {
  const std::vector<HeaderCase> cases = {
      {"field.nrrd", {}, false},
      {"field.nrrd", {"--space", "RAS"}},
      {"field.nrrd", {"--space", "LPS"}, false},
      {"field.nrrd", {"--local-origin"}},
      {"field.nrrd", {"--invert"}},
      {"field.nrrd", {"--closed"}},
      {"field.nrrd", {"--keep-largest", "1"}},
      {"field.nrrd", {"--region", "1:19,0:9,1:9"}},
      {"field.nrrd", {"--smooth", "0.7123456789012345"}},
      {"field.nrrd", {"--max-error", "0.30123456789012345"}, false},
      {"field.nrrd", {"--set", "promise.max_distance=1.25"}, false},
      {"field.nrrd", {"--set", "spacing=ignore", "--max-error", "0.15"}, false},
      {"nan.nrrd", {"--nan", "inside"}},
      {"nan.nrrd", {"--nan", "outside"}},
      {"labels.nrrd", {"--label", "2"}},
      {"low.nrrd", {"--label", "-2147483647"}},
      {"field.nrrd", {"--invert", "--closed"}},
      {"field.nrrd", {"--closed", "--region", "1:19,0:9,1:9"}},
      {"field.nrrd", {"--local-origin", "--space", "RAS", "--region", "1:19,0:9,1:9"}},
      {"nan.nrrd",
       {"--space", "RAS", "--local-origin", "--closed", "--invert", "--nan", "inside", "--keep-largest", "1",
        "--region", "1:19,0:9,1:9", "--set", "promise.max_distance=0.75"}},
      {"labels.nrrd",
       {"--label", "2", "--space", "RAS", "--local-origin", "--closed", "--keep-largest", "1", "--smooth", "0.75",
        "--region", "1:19,0:9,1:9"}},
      {"low.nrrd",
       {"--label", "-2147483647", "--space", "RAS", "--local-origin", "--closed", "--invert", "--smooth",
        "0.7123456789012345"}},
  };
  const std::string silent = folder_ / "silent.stl";
  for (const HeaderCase& c : cases) {
    std::string name = c.volume;
    for (const std::string& option : c.options) name += " " + option;
    SCOPED_TRACE(name);
    const ProgramResult made = mesh(c.volume, joined_arguments(isovalue_of(c.volume), c.options));
    ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
    EXPECT_EQ(made.err.find("no room"), std::string::npos) << made.err;
    EXPECT_TRUE(header().starts_with("DelIso")) << header();
    const ProgramResult verified = verify(c.volume, isovalue_of(c.volume), mesh_);
    EXPECT_EQ(verified.exit_code, 0) << header() << '\n' << verified.err << verified.out;
    write_file(silent, std::string(kLetters, ' ') + read_file(mesh_).substr(kLetters));
    EXPECT_EQ(verify(c.volume, isovalue_of(c.volume), silent).exit_code != 0, c.is_needed);
  }
}

// What has no room is told, in the words in which `verify` takes it.
TEST_F(StlHeader, OptionsWithoutRoomAreTold) {
  const Arguments options = {"--space",
                             "RAS",
                             "--local-origin",
                             "--closed",
                             "--invert",
                             "--keep-largest",
                             "1",
                             "--smooth",
                             "0.3123456789012345",
                             "--set",
                             "promise.max_distance=0.7123456789012345",
                             "--region",
                             "1:19,0:9,1:9"};
  const ProgramResult made = mesh("field.nrrd", joined_arguments({"--isovalue", "0.0123"}, options));
  ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
  const std::string before = "has to be given ";
  const std::size_t begin = made.err.find(before);
  ASSERT_NE(begin, std::string::npos) << made.err;
  const std::size_t first = begin + before.size();
  std::istringstream text(made.err.substr(first, made.err.find(" (", first) - first));
  Arguments told = {"--isovalue", "0.0123"};
  for (std::string word; text >> word;) told.push_back(word);
  EXPECT_GT(told.size(), 2u);
  const ProgramResult verified = verify("field.nrrd", told, mesh_);
  EXPECT_EQ(verified.exit_code, 0) << made.err << header() << verified.err << verified.out;
  EXPECT_NE(verify("field.nrrd", {"--isovalue", "0.0123"}, mesh_).exit_code, 0);
  const ProgramResult quiet = mesh("field.nrrd", joined_arguments({"--isovalue", "0.0123", "--quiet"}, options));
  EXPECT_EQ(quiet.err, "");
}

TEST_F(StlHeader, HeadersOfEarlierVersionsCountAsBefore) {
  ASSERT_EQ(mesh("field.nrrd", {"--isovalue", "0.0123", "--closed"}).exit_code, 0);
  const std::string rest = read_file(mesh_).substr(kLetters);
  std::string old = "DelIso 0.2.0, isovalue 0.0123; promise.max_distance 1; boundary closed";
  old.resize(kLetters, ' ');
  write_file(mesh_, old + rest);
  EXPECT_EQ(verify("field.nrrd", {"--isovalue", "0.0123"}, mesh_).exit_code, 0);
}

// Headers of others, whatever their bytes, say nothing and break nothing.
TEST_F(StlHeader, OtherHeadersSayNothing) {
  ASSERT_EQ(mesh("field.nrrd", {"--isovalue", "0.0123"}).exit_code, 0);
  const std::string rest = read_file(mesh_).substr(kLetters);
  std::string all_bytes;
  for (int c = 255; c > 255 - static_cast<int>(kLetters); --c) all_bytes += static_cast<char>(c);
  for (std::string other :
       {all_bytes, std::string("solid DelIso closed"), std::string("DelIso closed please"), std::string("DelIso  "),
        std::string("DelIso closed\0inv", 17), std::string("DelIsoclosed"), std::string("DelIso l= d= r=1"),
        std::string("delIso closed; DelIso inv"), std::string(kLetters, '\0'), std::string(kLetters, ';')}) {
    other.resize(kLetters, '\0');
    write_file(mesh_, other + rest);
    const ProgramResult verified = verify("field.nrrd", {"--isovalue", "0.0123"}, mesh_);
    EXPECT_EQ(verified.exit_code, 0) << other << verified.err << verified.out;
    EXPECT_EQ(run_deliso({"info", mesh_, "--json"}).exit_code, 0) << other;
  }
}

TEST(StlNotes, ShortWordsComeBackAsTheLinesThatDecide) {
  const MeshComments lines = {"DelIso 0.2.0, isovalue 40",
                              "promise.max_distance 0.75",
                              "components dropped 3",
                              "region 0:9,2:8,1:7",
                              "boundary closed",
                              "space right-anterior-superior, units mm",
                              "local origin 1 2 3, to be added to every vertex",
                              "volume a.nrrd",
                              "samples sha256 0123"};
  const StlNotes notes = short_stl_notes(lines);
  EXPECT_EQ(notes.options_needed, "");
  EXPECT_EQ(notes.comments, (MeshComments{"DelIso RAS closed local drop=3 d=.75 r=0:9,2:8,1:7", "isovalue 40",
                                          "local origin 1 2 3", "version 0.2.0", "volume a.nrrd"}));
  const MeshComments back = long_stl_notes(notes.comments);
  for (const std::size_t n : {1u, 2u, 3u, 4u}) {
    EXPECT_NE(std::find(back.begin(), back.end(), lines[n]), back.end()) << lines[n];
  }
  EXPECT_EQ(long_stl_notes(lines), lines);
  // Defaults take no room.
  const StlNotes plain = short_stl_notes({"DelIso 0.2.0, isovalue 40", "promise.max_distance 1", "volume a.nrrd"});
  EXPECT_EQ(plain.comments, (MeshComments{"DelIso", "isovalue 40", "version 0.2.0", "volume a.nrrd"}));
}

}  // namespace
}  // namespace deliso::testing
