// Every bad input: one line on stderr that names what is wrong, exit code 2, nothing on stdout, no file written.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// A NRRD file from its header fields and the bytes that follow.
std::string nrrd(const std::string& fields, const std::string& bytes) {
  return "NRRD0004\ndimension: 3\n" + fields + "\n\n" + bytes;
}

// 4 x 4 x 4 samples of a ramp: 0 to 63.
std::string ramp() {
  std::string bytes;
  for (char sample = 0; sample < 64; ++sample) bytes += sample;
  return bytes;
}

std::string good_volume() { return nrrd("type: uint8\nsizes: 4 4 4\nencoding: raw", ramp()); }

// Runs the command in a folder that holds `volume` as v.nrrd; "@" in an argument is the folder.
class BadInput : public ::testing::Test {
 protected:
  // Expects the refusal with every one of `parts` in its message.
  void expect_refusal(std::vector<std::string> arguments, const std::vector<std::string>& parts) {
    for (std::string& argument : arguments) {
      const std::size_t at = argument.find('@');
      if (at != std::string::npos) argument.replace(at, 1, folder_.path().string());
    }
    const std::vector<std::string> before = folder_.names();
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << " in " << result.err;
    EXPECT_EQ(folder_.names(), before);
  }
  // A volume that must be refused by every command that reads one.
  void expect_bad_volume(const std::string& bytes, const std::vector<std::string>& parts) {
    write_file(folder_ / "v.nrrd", bytes);
    expect_refusal({"mesh", "@/v.nrrd", "--isovalue", "30.5", "-o", "@/m.ply", "--report", "@/r.json"}, parts);
    expect_refusal({"info", "@/v.nrrd", "--report", "@/r.json"}, parts);
    expect_refusal({"topology", "@/v.nrrd", "--isovalue", "30.5", "--report", "@/r.json"}, parts);
  }
  // Arguments that must be refused although the volume is good.
  void expect_bad_mesh_options(const std::vector<std::string>& options, const std::vector<std::string>& parts) {
    write_file(folder_ / "v.nrrd", good_volume());
    std::vector<std::string> arguments = {"mesh", "@/v.nrrd"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refusal(arguments, parts);
  }

  TemporaryFolder folder_;
};

TEST_F(BadInput, EmptyNamesOfInputs) {
  const std::string found = ": expected a name, found an empty one";
  expect_refusal({"mesh", "", "--isovalue", "1", "-o", "@/m.ply"}, {"deliso: VOLUME" + found});
  expect_refusal({"verify", "", "@/v.nrrd", "--isovalue", "1"}, {"deliso: MESH" + found});
  expect_refusal({"topology", "", "--isovalue", "1"}, {"deliso: VOLUME" + found});
  expect_refusal({"info", ""}, {"deliso: VOLUME" + found});
  expect_refusal({"render", "", "--isovalue", "1", "-o", "@/p.png"}, {"deliso: VOLUME" + found});
  expect_refusal({"run", ""}, {"deliso: EXPERIMENT" + found});
  expect_refusal({"table", ""}, {"deliso: OUT_DIR" + found});
  expect_refusal({"table", "@", ""}, {"deliso: OUT_DIR" + found});
}

TEST_F(BadInput, NamesThatTellNoFormat) {
  for (const char* name : {"volume", "volume.png"}) {
    expect_refusal({"info", "@/" + std::string(name)}, {name, "there is no such file"});
    std::ofstream(folder_ / name) << "no volume";
  }
  expect_refusal({"info", "@/volume"}, {"/volume: has no extension, a volume is read from .nrrd, .nhdr, .nii"});
  expect_refusal({"info", "@/volume.png"}, {"/volume.png: has the extension \".png\", a volume is read from"});
}

TEST_F(BadInput, TruncatedData) {
  expect_bad_volume(nrrd("type: uint8\nsizes: 4 4 4\nencoding: raw", ramp().substr(1)), {"v.nrrd", "64"});
  expect_bad_volume(nrrd("type: uint8\nsizes: 4 4 4\nencoding: gzip", "\x1f\x8b\x08"), {"v.nrrd"});
}

TEST_F(BadInput, OversizedData) {
  expect_bad_volume(nrrd("type: uint8\nsizes: 4 4 4\nencoding: raw", ramp() + "x"), {"v.nrrd"});
}

TEST_F(BadInput, UnknownType) {
  expect_bad_volume(nrrd("type: complex\nsizes: 4 4 4\nencoding: raw", ramp()), {"v.nrrd", "complex"});
}

TEST_F(BadInput, UnknownEncoding) {
  expect_bad_volume(nrrd("type: uint8\nsizes: 4 4 4\nencoding: zstd", ramp()), {"v.nrrd", "zstd"});
}

TEST_F(BadInput, ZeroOrAbsurdDims) {
  for (const std::string sizes : {"0 4 4", "1 8 8", "-4 4 4", "4 4", "4 4 4 4", "2147483647 2147483647 2147483647",
                                  "4294967296 4294967296 4", "99999999999999999999 1 1", "1e9 4 4", "four 4 4"}) {
    SCOPED_TRACE(sizes);
    expect_bad_volume(nrrd("type: uint8\nsizes: " + sizes + "\nencoding: raw", ramp()), {"v.nrrd"});
  }
}

TEST_F(BadInput, HeaderThatLies) {
  // It promises much more than the file can hold: no attempt to allocate that.
  expect_bad_volume(nrrd("type: double\nsizes: 4000 4000 4000\nencoding: raw", ramp()), {"v.nrrd"});
  expect_bad_volume(nrrd("type: int16\nendian: little\nsizes: 4 4 4\nencoding: raw", ramp()), {"v.nrrd"});
  expect_bad_volume("NRRD0004\ntype: uint8\ndimension: 2\nsizes: 8 8\nencoding: raw\n\n" + ramp(), {"v.nrrd"});
  expect_bad_volume("not a volume at all\n", {"v.nrrd"});
  expect_bad_volume("", {"v.nrrd"});
}

TEST_F(BadInput, SamplesThatAreNoNumbers) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> samples(64, 1.0f);
    samples[0] = 60;
    samples[21] = bad;
    std::string bytes(sizeof(float) * samples.size(), '\0');
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    write_file(folder_ / "v.nrrd", nrrd("type: float\nendian: little\nsizes: 4 4 4\nencoding: raw", bytes));
    const std::vector<std::string> parts = {"v.nrrd", "sample (1, 1, 1)", "--nan outside"};
    expect_refusal({"mesh", "@/v.nrrd", "--isovalue", "30.5", "-o", "@/m.ply", "--report", "@/r.json"}, parts);
    expect_refusal({"topology", "@/v.nrrd", "--isovalue", "30.5", "--report", "@/r.json"}, parts);
  }
}

TEST_F(BadInput, MissingFileOrFolderInstead) {
  expect_refusal({"mesh", "@/none.nrrd", "--isovalue", "3", "-o", "@/m.ply"}, {"none.nrrd"});
  std::filesystem::create_directory(folder_ / "d.nrrd");
  std::filesystem::create_directory(folder_ / "d.ply");
  expect_refusal({"info", "@/d.nrrd"}, {"d.nrrd"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/d.ply"}, {"d.ply", "directory"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--config", "@/d.ply"}, {"d.ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--config", "@/none.json"}, {"none.json"});
  expect_refusal({"verify", "@/none.ply", "@/v.nrrd", "--isovalue", "3"}, {"none.ply", "no such file"});
  expect_refusal({"verify", "@/d.ply", "@/v.nrrd", "--isovalue", "3"}, {"d.ply", "not a regular file"});
}

TEST_F(BadInput, UnknownExtension) {
  write_file(folder_ / "v.xyz", "no volume");
  expect_refusal({"info", "@/v.xyz"}, {"v.xyz", ".vtk"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.xyz"}, {"m.xyz", ".ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m"}, {".ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--stage1-out", "@/s.xyz"}, {"s.xyz", ".ply"});
  expect_refusal({"generate", "sphere", "--size", "8", "-o", "@/g.txt"}, {".nrrd"});
}

TEST_F(BadInput, UnwritableOutput) {
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/none/m.ply"}, {"-o", "none/m.ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--report", "@/none/r.json"}, {"--report", "r.json"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--stage1-out", "@/m.ply"}, {"--stage1-out", "-o"});
  // Nobody can make a file there, not even root.
  expect_bad_mesh_options({"--isovalue", "3", "-o", "/proc/m.ply"}, {"-o", "/proc/m.ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--report", "/proc/r.json"}, {"--report"});
  expect_refusal({"generate", "sphere", "--size", "8", "-o", "@/none/g.nrrd"}, {"none"});
}

// A pipe cannot be replaced by a whole file, and one that nobody reads would keep the program waiting for ever.
TEST_F(BadInput, PipesAsOutput) {
  ASSERT_EQ(::mkfifo((folder_ / "m.ply").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder_ / "g.nrrd").c_str(), 0600), 0);
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply"}, {"-o", "m.ply", "regular file"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/n.ply", "--stage1-out", "@/m.ply"}, {"--stage1-out", "m.ply"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/n.ply", "--report", "@/m.ply"},
                          {"--report", "m.ply", "no program reads this pipe"});
  expect_refusal({"verify", "@/m.ply", "@/v.nrrd", "--isovalue", "3"}, {"m.ply", "regular file"});
  expect_refusal({"generate", "sphere", "--size", "8", "-o", "@/g.nrrd"}, {"-o", "g.nrrd", "regular file"});
}

TEST_F(BadInput, EmptyNames) {
  for (const std::string option : {"--report", "--config", "--stage1-out"}) {
    expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", option, ""}, {option, "empty"});
  }
  expect_bad_mesh_options({"--isovalue", "3", "-o", ""}, {"-o"});
  expect_refusal({"info", "@/v.nrrd", "--report", ""}, {"--report", "empty"});
  expect_refusal({"topology", "@/v.nrrd", "--isovalue", "3", "--report", ""}, {"--report", "empty"});
  expect_refusal({"verify", "@/m.ply", "@/v.nrrd", "--isovalue", "3", "--report", ""}, {"--report", "empty"});
  for (const std::string option : {"--data", "--out"}) expect_refusal({"run", "e.json", option, ""}, {option, "empty"});
  for (const std::string option : {"--output", "--experiment"}) {
    expect_refusal({"table", "@", option, ""}, {option, "empty"});
  }
}

TEST_F(BadInput, IsovalueOutsideTheRangeNamesTheRange) {
  for (const std::string isovalue : {"63.5", "-0.5", "1e300", "-1e300"}) {
    SCOPED_TRACE(isovalue);
    expect_bad_mesh_options({"--isovalue", isovalue, "-o", "@/m.ply", "--report", "@/r.json"}, {"0 to 63"});
    expect_refusal({"topology", "@/v.nrrd", "--isovalue", isovalue}, {"0 to 63"});
  }
}

// Numbers are shown so that they can be told apart.
TEST_F(BadInput, IsovalueAtTheEndsOfTheRange) {
  const auto expect = [this](const std::string& isovalue, const std::string& end) {
    expect_bad_mesh_options({"--isovalue", isovalue, "-o", "@/m.ply"},
                            {"isovalue " + isovalue + " gives a surface with no point", "0 to 63" + end + "\n"});
    expect_refusal({"topology", "@/v.nrrd", "--isovalue", isovalue},
                   {"isovalue " + isovalue + " ", "0 to 63" + end + "\n"});
  };
  expect("63.0000001", "");
  expect("0", ", and an isovalue must lie above the minimum");
  expect("-1e-09", ", and an isovalue must lie above the minimum");
}

TEST_F(BadInput, IsovalueThatIsNoNumber) {
  for (const std::string isovalue :
       {"nan", "inf", "-inf", "abc", "", "1x", "0x10", "1e999", "1 2", "+", "+-3", "++3"}) {
    SCOPED_TRACE(isovalue);
    expect_bad_mesh_options({"--isovalue", isovalue, "-o", "@/m.ply"}, {"--isovalue"});
  }
}

TEST_F(BadInput, SurfaceWithoutAPoint) {
  write_file(folder_ / "v.nrrd", nrrd("type: uint8\nsizes: 4 4 4\nencoding: raw", std::string(64, '\7')));
  for (const std::string isovalue : {"7", "7.5", "6.5"}) {
    SCOPED_TRACE(isovalue);
    expect_refusal({"mesh", "@/v.nrrd", "--isovalue", isovalue, "-o", "@/m.ply", "--report", "@/r.json"}, {"7"});
    expect_refusal({"topology", "@/v.nrrd", "--isovalue", isovalue, "--report", "@/r.json"}, {"7"});
  }
}

TEST_F(BadInput, UnknownConfigKeyNamesTheNearest) {
  write_file(folder_ / "p.json", R"({"stage2": {"epsilon_1": 0.2}})");
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--config", "@/p.json"},
                          {"p.json", "stage2.epsilon_1", "'stage2.epsilon1'"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--set", "budget.second=3"}, {"'budget.seconds'"});
}

TEST_F(BadInput, ConfigValuesOutOfRange) {
  write_file(folder_ / "p.json", R"({"stage2": {"rho": 0.5}})");
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--config", "@/p.json"}, {"stage2.rho", ">= 1", "0.5"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--set", "stage1.epsilon=-1"}, {"> 0", "-1"});
  write_file(folder_ / "p.json", "{\"stage2\": \n {\"rho\": }}");
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--config", "@/p.json"}, {"p.json", "line 2"});
}

TEST_F(BadInput, SetWithoutAValue) {
  for (const std::string assignment : {"certify", "=true", "", "stage1=3", "certify="}) {
    SCOPED_TRACE(assignment);
    expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--set", assignment}, {"--set"});
  }
}

TEST_F(BadInput, CountsThatAreNone) {
  for (const std::string text : {"-1", "1.5", "many", "18446744073709551616", ""}) {
    SCOPED_TRACE(text);
    expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--seed", text}, {"--seed"});
    expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--threads", text}, {"--threads"});
    expect_refusal({"generate", "sphere", "-o", "@/g.nrrd", "--size", text + "x"}, {"--size"});
  }
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--threads", "0"}, {"--threads"});
}

TEST_F(BadInput, RawFilesNeedADescriptionThatFits) {
  write_file(folder_ / "v.raw", ramp());
  expect_refusal({"info", "@/v.raw"}, {"v.raw"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,5", "--type", "u8"}, {"v.raw"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4", "--type", "u8"}, {"--dims"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,1", "--type", "u8"}, {"--dims"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,99999999999", "--type", "u8"}, {"--dims"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,4", "--type", "u9"}, {"--type", "u9"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,4", "--type", "u8", "--endian", "middle"}, {"--endian"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,4", "--type", "u8", "--spacing", "1,0,1"}, {"--spacing"});
  expect_refusal({"info", "@/v.raw", "--dims", "4,4,4", "--type", "u8", "--spacing", "1,nan,1"}, {"--spacing"});
  write_file(folder_ / "v.nrrd", good_volume());
  expect_refusal({"info", "@/v.nrrd", "--dims", "4,4,4"}, {"--dims", "v.nrrd"});
}

TEST_F(BadInput, MeshesThatAreNone) {
  write_file(folder_ / "v.nrrd", good_volume());
  write_file(folder_ / "m.ply", "ply\nformat ascii 1.0\nelement vertex 9\n");
  expect_refusal({"verify", "@/m.ply", "@/v.nrrd", "--isovalue", "30.5", "--report", "@/r.json"}, {"m.ply"});
  write_file(folder_ / "m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  expect_refusal({"verify", "@/m.off", "@/v.nrrd", "--isovalue", "30.5", "--report", "@/r.json"}, {"m.off"});
}

TEST_F(BadInput, UnknownCommandsAndOptions) {
  expect_refusal({"mesch"}, {"mesch", "'mesh'"});
  expect_refusal({}, {"deliso"});
  expect_refusal({"--verbose"}, {"--verbose"});
  expect_refusal({"info"}, {"VOLUME"});
  expect_refusal({"generate", "spere", "-o", "@/g.nrrd"}, {"spere", "sphere"});
  expect_refusal({"generate"}, {"NAME"});
  expect_refusal({"generate", "sphere"}, {"-o"});
  expect_bad_mesh_options({"--isovalue", "3"}, {"--output"});
  expect_bad_mesh_options({"-o", "@/m.ply"}, {"--isovalue"});
  expect_bad_mesh_options({"--isovalue", "3", "-o", "@/m.ply", "--sed", "3"}, {"--sed"});
  expect_bad_mesh_options({"--isovalue", "3", "--isovalue", "4", "-o", "@/m.ply"}, {"--isovalue"});
  expect_bad_mesh_options({"extra", "--isovalue", "3", "-o", "@/m.ply"}, {"extra"});
}

TEST_F(BadInput, NamesWithLineBreaksStillGiveOneLine) {
  expect_refusal({"info", "@/two\nlines.nrrd"}, {"two lines.nrrd"});
}

}  // namespace
}  // namespace deliso::testing
