// `deliso run` as a user meets it: records, resuming, shards, absent and wrong files, signals.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runs/record_file.h"
#include "tests/support/run_examples.h"
#include "volume/fields/field_slices.h"
#include "volume/io/sha256.h"
#include "volume/io/volume_file.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

class RunCommand : public ::testing::Test {
 protected:
  RunCommand() { write_file(folder_ / "small.json", kSmallExperiment); }

  ProgramResult run(const std::string& out, std::vector<std::string> more = {},
                    const std::string& name = "small.json") {
    std::vector<std::string> arguments = {"run", folder_ / name, "--out", folder_ / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  std::string table(const std::vector<std::string>& outs) {
    std::vector<std::string> arguments = {"table"};
    for (const std::string& out : outs) arguments.push_back(folder_ / out);
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return without_programs(result.out);
  }
  // Writes an experiment on one file that lies in the folder data.
  void write_file_experiment(const std::string& sha256) {
    std::filesystem::create_directories(folder_ / "data");
    Json document = small_document();
    document["datasets"] = Json::array({Json{{"name", "FILE"},
                                             {"file", "ball.nrrd"},
                                             {"isovalue", 0.3},
                                             {"sha256", sha256},
                                             {"get", "ask for it at the desk"}},
                                        Json{{"name", "ring"}, {"field", "torus"}, {"size", 8}}});
    write_file(folder_ / "file.json", json_text(document));
  }

  TemporaryFolder folder_;
};

TEST_F(RunCommand, WritesOneRecordForEachRunAndTheTables) {
  const ProgramResult result = run("out");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::vector<std::string> notes;
  const std::vector<Json> records = read_records(folder_ / "out/records.jsonl", notes);
  ASSERT_EQ(records.size(), 12u);
  EXPECT_TRUE(notes.empty());
  for (const Json& record : records) {
    EXPECT_EQ(record["experiment"], "small");
    EXPECT_EQ(record["status"], "done");
    EXPECT_EQ(record["seed"], record["repeat"]);
    EXPECT_TRUE(record["certificate"].contains("verdict"));
    EXPECT_TRUE(record["program"].contains("commit"));
    EXPECT_EQ(record["parameters"]["stage2"]["epsilon1"], record["variant"] == "fine" ? 0.1 : 0.3);
  }
  EXPECT_EQ(result.out, read_file(folder_ / "out/table.md"));
  EXPECT_MESSAGE(result.out, "| ring | coarse |");
}

TEST_F(RunCommand, EqualExperimentsGiveEqualTables) {
  run("a");
  run("b");
  EXPECT_EQ(read_file(folder_ / "a/table.csv"), read_file(folder_ / "b/table.csv"));
  EXPECT_EQ(table({"a"}), table({"b"}));
}

TEST_F(RunCommand, TwoShardsMergedGiveTheSameTable) {
  run("whole");
  // In a folder each ...
  EXPECT_EQ(run("one", {"--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(run("two", {"--shard", "2/2"}).exit_code, 0);
  EXPECT_EQ(table({"one", "two"}), table({"whole"}));
  EXPECT_EQ(table({"two", "one"}), table({"whole"}));
  EXPECT_NE(table({"one"}), table({"whole"}));
  // ... or in one folder.
  EXPECT_EQ(run("both", {"--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(run("both", {"--shard", "2/2"}).exit_code, 0);
  EXPECT_EQ(table({"both"}), table({"whole"}));
  EXPECT_EQ(read_file(folder_ / "both/table.csv"), read_file(folder_ / "whole/table.csv"));
}

TEST_F(RunCommand, ResumingAfterACutGivesTheSameTable) {
  run("whole");
  const std::string text = read_file(folder_ / "whole/records.jsonl");
  const std::string experiment = read_file(folder_ / "whole/experiment.json");
  // Cut at line ends, within lines, and before the first line has ended.
  const std::vector<std::size_t> cuts = {0, 10, text.find('\n'), text.find('\n') + 1, text.size() / 2, text.size() - 1};
  for (const std::size_t cut : cuts) {
    SCOPED_TRACE(cut);
    const TemporaryFolder cut_folder;
    write_file(cut_folder / "experiment.json", experiment);
    write_file(cut_folder / "records.jsonl", text.substr(0, cut));
    const ProgramResult result =
        run_deliso({"run", folder_ / "small.json", "--out", cut_folder.path().string(), "--resume"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(without_programs(result.out), table({"whole"}));
    // What was whole stays as it was; nothing is run twice.
    const std::string resumed = read_file(cut_folder / "records.jsonl");
    const std::size_t kept =
        cut == 0 || text.rfind('\n', cut - 1) == std::string::npos ? 0 : text.rfind('\n', cut - 1) + 1;
    EXPECT_EQ(resumed.substr(0, kept), text.substr(0, kept));
    EXPECT_EQ(std::count(resumed.begin(), resumed.end(), '\n'), 12);
  }
}

TEST_F(RunCommand, AnInterruptedRunEndsWithThreeAndGoesOn) {
  Json document = small_document();
  document["repeats"] = 40;
  write_file(folder_ / "long.json", json_text(document));
  const ProgramResult stopped = run_deliso({"run", folder_ / "long.json", "--out", folder_ / "out"},
                                           SignalAfter{.file = folder_ / "out/records.jsonl"});
  EXPECT_EQ(stopped.exit_code, 3) << stopped.err;
  EXPECT_MESSAGE(stopped.err, "--resume goes on");
  EXPECT_EQ(stopped.out, "");
  const std::string before = read_file(folder_ / "out/records.jsonl");
  const ProgramResult resumed = run("out", {"--resume"}, "long.json");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  const std::string after = read_file(folder_ / "out/records.jsonl");
  EXPECT_TRUE(after.starts_with(before));
  EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), 160);
  run("whole", {}, "long.json");
  EXPECT_EQ(table({"out"}), table({"whole"}));
}

TEST_F(RunCommand, RecordsAreNotOverwritten) {
  run("out");
  const std::string before = read_file(folder_ / "out/records.jsonl");
  const ProgramResult again = run("out");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_MESSAGE(again.err, "--resume");
  Json document = small_document();
  document["title"] = "Changed";
  write_file(folder_ / "small.json", json_text(document));
  const ProgramResult other = run("out");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_MESSAGE(other.err, "another experiment");
  EXPECT_EQ(read_file(folder_ / "out/records.jsonl"), before);
}

TEST_F(RunCommand, ADamagedExperimentInTheFolderIsToldOfAsDamaged) {
  run("out");
  write_file(folder_ / "out/experiment.json", "{\"title\": ");
  const ProgramResult result = run("out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  EXPECT_MESSAGE(result.err, (folder_ / "out/experiment.json") + ": not valid JSON, ");
}

TEST_F(RunCommand, AbsentDataSetsAreListedAndMadeUpForLater) {
  const ScalarGrid ball = generate_field("sphere", 8);
  write_file_experiment(sample_sha256(ball));
  const ProgramResult absent = run("out", {"--data", folder_ / "data"}, "file.json");
  EXPECT_EQ(absent.exit_code, 0) << absent.err;
  EXPECT_EQ(std::count(absent.err.begin(), absent.err.end(), '\n'), 1) << absent.err;
  EXPECT_MESSAGE(absent.err, "absent: FILE: ball.nrrd is not in");
  EXPECT_MESSAGE(absent.err, "ask for it at the desk");
  EXPECT_MESSAGE(absent.out, "| FILE | fine | absent |");
  EXPECT_MESSAGE(absent.out, "FILE is absent (ball.nrrd): ask for it at the desk");
  // The file comes, the experiment is finished.
  write_volume(ball, folder_ / "data/ball.nrrd");
  const ProgramResult present = run("out", {"--data", folder_ / "data", "--resume"}, "file.json");
  EXPECT_EQ(present.exit_code, 0) << present.err;
  EXPECT_EQ(present.out.find("absent"), std::string::npos) << present.out;
  EXPECT_EQ(present.out.find("Remarks"), std::string::npos) << present.out;
}

// A default folder may be missing, one that was named may not.
TEST_F(RunCommand, ADataFolderThatIsNoneIsRefused) {
  const std::vector<std::string> before = folder_.names();
  for (const std::string name : {"none", "small.json"}) {
    const ProgramResult result = run("out", {"--data", folder_ / name});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_MESSAGE(result.err, "--data: expected a folder");
    EXPECT_MESSAGE(result.err, folder_ / name);
  }
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(RunCommand, AWrongFileFailsItsRunsWithBothHashes) {
  const std::string expected(64, 'a');
  write_file_experiment(expected);
  const ScalarGrid ball = generate_field("sphere", 8);
  write_volume(ball, folder_ / "data/ball.nrrd");
  const ProgramResult result = run("out", {"--data", folder_ / "data"}, "file.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 6) << result.err;
  for (const std::string& text : {result.err, result.out}) {
    EXPECT_MESSAGE(text, expected);
    EXPECT_MESSAGE(text, sample_sha256(ball));
  }
}

// Whatever is wrong with a volume: its runs have failed, those of the others are made, as with built-in fields.
TEST_F(RunCommand, AVolumeThatCannotBeLoadedFailsItsRunsAlone) {
  const ScalarGrid ball = generate_field("sphere", 8);
  write_file_experiment(sample_sha256(ball));
  Json document = read_json(folder_ / "file.json");
  document["datasets"].push_back(Json{{"name", "empty"}, {"field", "sphere"}, {"size", 8}, {"isovalue", 1e9}});
  const auto expect_failed = [&](const std::string& out, const std::string& reason) {
    SCOPED_TRACE(out);
    write_file(folder_ / "file.json", json_text(document));
    const ProgramResult result = run(out, {"--data", folder_ / "data"}, "file.json");
    EXPECT_EQ(result.exit_code, 1);
    for (const std::string name : {"FILE", "empty"}) {
      EXPECT_MESSAGE(result.err, "deliso: failed: " + name + ", fine, repeat 1: ");
      EXPECT_MESSAGE(result.out, "| " + name + " | fine | failed |");
    }
    EXPECT_MESSAGE(result.err, reason);
    EXPECT_MESSAGE(result.out, "FILE, coarse, repeat 3 failed: ");
    EXPECT_EQ(result.out.find("| ring | fine | failed"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("ring: "), std::string::npos) << result.out;
    EXPECT_EQ(result.out, read_file(folder_ / (out + "/table.md")));
  };
  write_file(folder_ / "data/ball.nrrd", "NRRD0004\n");
  expect_failed("unreadable", "ball.nrrd");
  write_volume(ball, folder_ / "data/ball.nrrd");
  document["datasets"][0]["isovalue"] = 7;
  expect_failed("no_surface", "has no point");
  document["datasets"][0]["isovalue"] = 0.3;
  document["datasets"][0]["sha256"] = std::string(64, 'a');
  expect_failed("wrong_hash", sample_sha256(ball));
  // The right file comes: the rest of the experiment is made.
  document["datasets"][0]["sha256"] = sample_sha256(ball);
  document["datasets"].erase(2);
  write_file(folder_ / "file.json", json_text(document));
  write_file(folder_ / "data/ball.nrrd", "");
  EXPECT_EQ(run("out", {"--data", folder_ / "data"}, "file.json").exit_code, 1);
  write_volume(ball, folder_ / "data/ball.nrrd");
  const ProgramResult resumed = run("out", {"--data", folder_ / "data", "--resume"}, "file.json");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("failed"), std::string::npos) << resumed.out;
}

TEST_F(RunCommand, AFailedRunIsRecordedAndTheOthersAreDone) {
  Json document = small_document();
  // No seeds and no random points: nothing to start from.
  document["variants"].push_back(
      Json{{"name", "none"}, {"set", {{"initial.seeding", "random"}, {"initial.random_points", 0}}}});
  write_file(folder_ / "small.json", json_text(document));
  const ProgramResult result = run("out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_MESSAGE(result.err, "failed: ball, none, repeat 1");
  EXPECT_MESSAGE(result.out, "| ball | none | failed |");
  EXPECT_MESSAGE(result.out, "initial.random_points");
}

TEST_F(RunCommand, BuiltinChangesNothingWhereAllFieldsAreBuiltIn) {
  const ProgramResult result = run("builtin", {"--builtin"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  run("plain");
  EXPECT_EQ(read_file(folder_ / "builtin/experiment.json"), read_file(folder_ / "plain/experiment.json"));
  EXPECT_EQ(table({"builtin"}), table({"plain"}));
  EXPECT_EQ(run("builtin", {"--builtin", "--resume"}).exit_code, 0);
  // Files have nothing that stands in for them.
  write_file_experiment(std::string(64, 'a'));
  const ProgramResult refused = run("file", {"--builtin"}, "file.json");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_MESSAGE(refused.err, "--builtin: the experiment file needs the file ball.nrrd and names no builtin_datasets");
}

TEST_F(RunCommand, ADryRunListsTheRunsAndWritesNothing) {
  const ProgramResult result = run("out", {"--dry-run", "--shard", "2/3"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 4);
  EXPECT_MESSAGE(result.out, "ball, coarse, repeat 1, seed 1");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(RunCommand, BadShardsAreRefused) {
  for (const std::string shard : {"", "1", "0/2", "3/2", "1/0", "a/b", "1/2/3", "-1/2"}) {
    const ProgramResult result = run("out", {"--shard", shard});
    EXPECT_EQ(result.exit_code, 2) << shard;
    EXPECT_MESSAGE(result.err, "--shard");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace deliso::testing
