// What the commands print and write when all is well.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "experiments/config/json.h"
#include "tests/support/program_runner.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"

namespace deliso::testing {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Usage, VersionNamesVersionCommitCompilerAndFlags) {
  const ProgramResult result = run_deliso({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out.starts_with("deliso 0.2.0\ncommit   ")) << result.out;
  EXPECT_TRUE(contains(result.out, "\ncompiler "));
  EXPECT_TRUE(contains(result.out, "-ffp-contract=off"));
}

TEST(Usage, HelpNamesEveryCommandAndParameter) {
  const ProgramResult help = run_deliso({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const std::string command : {"mesh", "verify", "topology", "info", "generate", "schema"}) {
    EXPECT_TRUE(contains(help.out, "  " + command + " ")) << command;
    EXPECT_EQ(run_deliso({command, "--help"}).exit_code, 0) << command;
  }
  const ProgramResult parameters = run_deliso({"mesh", "--help-parameters"});
  EXPECT_EQ(parameters.exit_code, 0);
  EXPECT_TRUE(contains(parameters.out, "stage2.epsilon1 = 0.1"));
  const std::string mesh_help = run_deliso({"mesh", "--help"}).out;
  EXPECT_FALSE(contains(mesh_help, "stage2.epsilon1 = 0.1"));
  EXPECT_TRUE(contains(mesh_help, "--help-parameters"));
}

TEST(Usage, EveryHelpHasExamples) {
  for (const std::string command :
       {"mesh", "verify", "topology", "info", "generate", "run", "table", "render", "explain", "schema"}) {
    EXPECT_TRUE(contains(run_deliso({command, "--help"}).out, "Examples:\n  deliso " + command + " ")) << command;
  }
}

TEST(Usage, AnOptionWithoutItsValueIsNamed) {
  const auto refusal = [](std::vector<std::string> arguments) {
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_EQ(refusal({"mesh", "v.nrrd", "--isovalue", "-o", "x.ply"}),
            "deliso: --isovalue: expected a value, found the option '-o'\n");
  EXPECT_EQ(refusal({"mesh", "v.nrrd", "-o", "--isovalue", "3"}),
            "deliso: -o: expected a value, found the option '--isovalue'\n");
  EXPECT_EQ(refusal({"mesh", "v.nrrd", "-o", "x.ply", "--isovalue"}),
            "deliso: --isovalue: expected a value, found the end of the command line\n");
  // As from a script whose variable is not set.
  const std::string empty = ": expected a value, found an empty one (deliso --help tells more)\n";
  EXPECT_EQ(refusal({"generate", "sphere", "--size", "", "-o", "x.nrrd"}), "deliso: --size" + empty);
  EXPECT_EQ(refusal({"mesh", "v.nrrd", "--isovalue", "3", "-o", "x.ply", "--format", ""}), "deliso: --format" + empty);
  EXPECT_EQ(refusal({"verify", "x.ply", "v.nrrd", "--isovalue", "3", "--space", ""}), "deliso: --space" + empty);
  EXPECT_EQ(refusal({"info", "x.ply", "--format", ""}), "deliso: --format" + empty);
  EXPECT_EQ(refusal({"render", "v.nrrd", "--isovalue", "3", "-o", "x.png", "--size", ""}), "deliso: --size" + empty);
  EXPECT_EQ(refusal({"explain", "--isovalue", "", "-o", "x.html"}), "deliso: --isovalue" + empty);
  // A negative number and a lone dash are values.
  EXPECT_TRUE(contains(refusal({"mesh", "no.nrrd", "--isovalue", "-3", "-o", "-"}), "no.nrrd"));
}

TEST(Usage, AnOptionGivenTwiceIsNamed) {
  const ProgramResult twice = run_deliso({"mesh", "v.nrrd", "--isovalue", "1", "--isovalue=1", "-o", "x.ply"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_EQ(twice.err, "deliso: --isovalue was given twice, expected once (deliso --help tells more)\n");
  const ProgramResult thrice =
      run_deliso({"topology", "v.nrrd", "--isovalue", "1", "--report", "a", "--report", "b", "--report", "c"});
  EXPECT_EQ(thrice.err, "deliso: --report was given 3 times, expected once (deliso --help tells more)\n");
}

TEST(Usage, GenerateListsAndWritesEveryField) {
  const TemporaryFolder folder;
  const ProgramResult list = run_deliso({"generate", "--list"});
  EXPECT_EQ(list.exit_code, 0);
  const ProgramResult both = run_deliso({"generate", "torus", "--list", "-o", folder / "y.nrrd"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_TRUE(contains(both.err, "generate: --list writes no volume")) << both.err;
  EXPECT_TRUE(folder.names().empty());
  for (const AnalyticField& field : analytic_fields()) {
    EXPECT_TRUE(contains(list.out, field.name));
    const ProgramResult result =
        run_deliso({"generate", field.name, "-o", folder / (field.name + ".nrrd"), "--size", "12"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_EQ(folder.names().size(), analytic_fields().size());
}

TEST(Usage, GenerateWritesRawAndCompressedVolumesOfTheSameSamples) {
  const TemporaryFolder folder;
  const auto generate = [&](const std::string& file, const std::string& encoding) {
    return run_deliso({"generate", "blobs", "-o", folder / file, "--size", "9", "--encoding", encoding});
  };
  EXPECT_EQ(generate("a.nrrd", "raw").exit_code, 0);
  EXPECT_EQ(generate("b.nrrd", "gzip").exit_code, 0);
  EXPECT_NE(read_file(folder / "a.nrrd"), read_file(folder / "b.nrrd"));
  EXPECT_EQ(read_volume(folder / "a.nrrd").samples(), generate_field("blobs", 9).samples());
  EXPECT_EQ(read_volume(folder / "b.nrrd").samples(), generate_field("blobs", 9).samples());
  const ProgramResult refused = generate("c.nrrd", "zip");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "\"zip\""));
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(Usage, GenerateIsReproducibleAndSeeded) {
  const TemporaryFolder folder;
  for (const std::string name : {"a", "b", "c"}) {
    const std::string seed = name == "c" ? "2" : "1";
    ASSERT_EQ(
        run_deliso({"generate", "noise", "-o", folder / (name + ".nrrd"), "--size", "9", "--seed", seed}).exit_code, 0);
  }
  EXPECT_EQ(read_file(folder / "a.nrrd"), read_file(folder / "b.nrrd"));
  EXPECT_NE(read_file(folder / "a.nrrd"), read_file(folder / "c.nrrd"));
}

TEST(Usage, InfoTellsWhatTheFileHolds) {
  const TemporaryFolder folder;
  // Two values far apart: every threshold between them separates the classes.
  std::string bytes(64, '\12');
  bytes.replace(0, 16, std::string(16, '\144'));
  write_file(folder / "v.nrrd",
             "NRRD0004\ndimension: 3\ntype: uint8\nsizes: 4 4 4\nspacings: 1 2 3\nencoding: raw\n\n" + bytes);
  const ProgramResult result = run_deliso({"info", folder / "v.nrrd", "--json", "--report", folder / "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json report = parse_json(result.out, "stdout");
  EXPECT_EQ(report, read_json(folder / "r.json"));
  EXPECT_EQ(report["volume"]["dims"], Json::array({4, 4, 4}));
  EXPECT_EQ(report["volume"]["type"], "u8");
  EXPECT_EQ(report["volume"]["spacing"], Json::array({1, 2, 3}));
  EXPECT_EQ(report["volume"]["range"], Json::array({10, 100}));
  EXPECT_EQ(report["volume"]["sha256"].get<std::string>().size(), 64u);
  std::uint64_t count = 0;
  for (const Json& bin : report["histogram"]["counts"]) count += bin.get<std::uint64_t>();
  EXPECT_EQ(count, 64u);
  ASSERT_FALSE(report["suggested_isovalues"].empty());
  const double isovalue = report["suggested_isovalues"][0]["isovalue"].get<double>();
  EXPECT_GT(isovalue, 10);
  EXPECT_LT(isovalue, 100);
  EXPECT_TRUE(contains(run_deliso({"info", folder / "v.nrrd"}).out, "suggested isovalue"));
  // One object, though two options ask for it; of meshes, too.
  EXPECT_EQ(run_deliso({"info", folder / "v.nrrd", "--json", "--report", "-"}).out, result.out);
  write_file(folder / "m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string of_mesh = run_deliso({"info", folder / "m.off", "--json"}).out;
  EXPECT_TRUE(contains(of_mesh, "deliso-mesh-info-1"));
  EXPECT_EQ(run_deliso({"info", folder / "m.off", "--json", "--report", "-"}).out, of_mesh);
}

// A row of the histogram for each value there can be, no row twice, and no table without a row.
TEST(Usage, InfoOfFewValuesHasFewRows) {
  const TemporaryFolder folder;
  const std::string header = "NRRD0004\ndimension: 3\ntype: uint8\nsizes: 4 4 4\nencoding: raw\n\n";
  const auto rows = [&](const std::string& bytes) {
    write_file(folder / "v.nrrd", header + bytes);
    const std::string out = run_deliso({"info", folder / "v.nrrd"}).out + "\n";
    const std::string histogram = out.substr(out.find("\n\n") + 2);
    const std::string table = histogram.substr(0, histogram.find("\n\n") + 1);
    EXPECT_EQ(contains(out, "suggested isovalue"), bytes != std::string(64, '\12'));
    return std::count(table.begin(), table.end(), '\n') - 2;  // without the two lines of the head
  };
  EXPECT_EQ(rows(std::string(64, '\12')), 1);
  EXPECT_EQ(rows(std::string(32, '\12') + std::string(32, '\14')), 3);
  EXPECT_EQ(rows(std::string(32, '\12') + std::string(32, '\144')), 16);
}

// A reader that waits at a pipe gets the whole report and nothing before it.
TEST(Usage, GenerateSuggestsNoIsovalueThatHasNoPoint) {
  const TemporaryFolder folder;
  for (const AnalyticField& field : analytic_fields()) {
    for (const std::string size : {"2", "3", "5"}) {
      const ProgramResult made = run_deliso({"generate", field.name, "--size", size, "-o", folder / "v.nrrd"});
      const bool has_points =
          run_deliso({"topology", folder / "v.nrrd", "--isovalue", shortest_text(field.isovalue)}).exit_code == 0;
      EXPECT_EQ(made.out.find("no point") == std::string::npos, has_points) << field.name << " " << size;
    }
  }
}

TEST(Usage, MisspeltOptionsAreNamedBeforeMissingOnes) {
  const ProgramResult result = run_deliso({"mesh", "v.nrrd", "--iso", "0.3", "-o", "x.ply"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("'--iso'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("nearest is '--isovalue'"), std::string::npos) << result.err;
  EXPECT_EQ(run_deliso({"info", "v.raw", "--dims", ""}).exit_code, 2);
}

TEST(Usage, ReportsGoIntoAPipeThatIsRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_deliso({"generate", "sphere", "--size", "8", "-o", folder / "v.nrrd"}).exit_code, 0);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int pipe = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(pipe, 0);
  const ProgramResult result = run_deliso({"info", folder / "v.nrrd", "--json", "--report", folder / "pipe"});
  std::string report(result.out.size() + 1, '\0');
  const ssize_t size = ::read(pipe, report.data(), report.size());
  ::close(pipe);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report.substr(0, static_cast<std::size_t>(size)), result.out);
}

TEST(Usage, InfoReadsRawFilesAsDescribed) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 60; ++i) bytes += {'\1', static_cast<char>(i)};
  write_file(folder / "v.raw", bytes);
  const ProgramResult result = run_deliso({"info", folder / "v.raw", "--dims", "3,4,5", "--type", "u16", "--endian",
                                           "big", "--spacing", "1,1,2.5", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json volume = parse_json(result.out, "stdout")["volume"];
  EXPECT_EQ(volume["dims"], Json::array({3, 4, 5}));
  EXPECT_EQ(volume["range"], Json::array({256, 315}));
  EXPECT_EQ(volume["spacing"], Json::array({1, 1, 2.5}));
}

TEST(Usage, TopologyOfKnownFieldsIsTheKnownOne) {
  const TemporaryFolder folder;
  for (const AnalyticField& field : analytic_fields()) {
    const auto known = field.known_topology(field.default_size);
    if (!known || field.default_size > 64) continue;
    SCOPED_TRACE(field.name);
    ASSERT_EQ(run_deliso({"generate", field.name, "-o", folder / "v.nrrd"}).exit_code, 0);
    const ProgramResult result = run_deliso(
        {"topology", folder / "v.nrrd", "--isovalue", std::to_string(field.isovalue), "--report", folder / "r.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = read_json(folder / "r.json");
    std::vector<KnownComponents> found;
    for (const Json& entry : report["isosurface"]) {
      found.push_back({entry["euler_characteristic"], entry["boundary_loops"], entry["count"]});
    }
    EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), known->begin(), known->end())) << report["isosurface"];
    EXPECT_TRUE(contains(result.out, "euler characteristic"));
  }
}

}  // namespace
}  // namespace deliso::testing
