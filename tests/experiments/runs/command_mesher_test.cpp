// Other programs as meshers: a variant with a command, judged as our own meshes are.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runs/record_file.h"
#include "experiments/system/program_launcher.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

class CommandMesher : public ::testing::Test {
 protected:
  // An experiment whose variant runs this shell script: $1 volume, $2 isovalue, $3 mesh, $4 report, $5 vertices, $6
  // deliso.
  Json document(const std::string& script, double timeout = 20) {
    write_file(folder_ / "mesher.sh", "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder_ / "mesher.sh", std::filesystem::perms::owner_all);
    Json json = small_document();
    json["distances"] = true;
    json["repeats"] = 1;
    json["datasets"] = Json::array({Json{{"name", "ring"}, {"field", "torus"}, {"size", 8}}});
    json["variants"] = Json::array(
        {Json{{"name", "ours"}},
         Json{{"name", "theirs"},
              {"mesher",
               {{"command", {"./mesher.sh", "{volume}", "{isovalue}", "{mesh}", "{report}", "{vertices}", "{deliso}"}},
                {"timeout", timeout}}}}});
    json["metrics"] = Json::array({Json{{"name", "vertices"}, {"value", "vertices"}},
                                   Json{{"name", "missed"}, {"value", "verification.components_missed"}},
                                   Json{{"name", "warm"}, {"value", "command.warm_seconds"}}});
    return json;
  }
  ProgramResult run(const Json& json, const std::vector<std::string>& more = {}) {
    write_file(folder_ / "other.json", json_text(json));
    std::vector<std::string> arguments = {"run", folder_ / "other.json", "--out", folder_ / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments);
  }
  std::vector<Json> records() {
    std::vector<std::string> notes;
    return read_records(folder_ / "out/records.jsonl", notes);
  }
  // The one sentence of the record of a mesher that fails.
  std::string failure(const std::string& script, double timeout = 20) {
    std::filesystem::remove_all(folder_ / "out");
    const ProgramResult result = run(document(script, timeout));
    EXPECT_EQ(result.exit_code, 1) << result.err;
    const std::vector<Json> all = records();
    EXPECT_EQ(all.size(), 2U);
    EXPECT_EQ(all.back()["status"], "failed");
    return all.back().value("error", "");
  }

  TemporaryFolder folder_;
};

// The same program from outside gives the same mesh, and the same judgement.
TEST_F(CommandMesher, OurOwnProgramIsJudgedAsFromWithin) {
  const ProgramResult result = run(document(R"("$6" mesh "$1" --isovalue "$2" -o "$3" --report "$4" --quiet \
    --set initial.random_points=10)"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::vector<Json> all = records();
  ASSERT_EQ(all.size(), 2U);
  for (const char* key : {"vertices", "triangles", "components", "boundary_loops", "quality", "distances",
                          "verification", "isovalue", "isovalue_used", "seed"}) {
    EXPECT_EQ(all[0][key], all[1][key]) << key;
  }
  EXPECT_EQ(all[1]["verification"]["components_missed"], 0);
  EXPECT_EQ(all[1]["verification"]["proven"], true);
  const Json& command = all[1]["command"];
  EXPECT_EQ(all[1]["total_seconds"], command["cold_seconds"]);  // the program told
  EXPECT_GE(command["wall_seconds"], command["cold_seconds"]);
  EXPECT_GT(command["peak_memory_bytes"], 1'000'000);
  EXPECT_EQ(all[1]["mesher"]["timeout"], 20);
  // Nothing is left, and the record holds.
  EXPECT_EQ(run(document("exit 1")).exit_code, 2);
  const ProgramResult plan = run(document("exit 1"), {"--resume", "--dry-run"});
  EXPECT_EQ(plan.out, "");
}

// A mesh that lacks a component and crosses itself is told of as such.
TEST_F(CommandMesher, WhatItMissesIsCounted) {
  Json json = document(R"(echo "{\"warm_seconds\": 0.25, \"total_seconds\": 0.5, \"version\": \"1.0\"}" > "$4"
    cat > "$3" <<END
OFF
4 4 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
END
)");
  json["variants"][1]["mesher"]["mesh_format"] = "off";
  EXPECT_EQ(run(json).exit_code, 0);
  const Json record = records().back();
  EXPECT_EQ(record["vertices"], 4);
  EXPECT_EQ(record["components"], 1);
  EXPECT_EQ(record["euler_characteristic"], 2);
  EXPECT_EQ(record["verification"]["components_expected"], 1);
  EXPECT_EQ(record["verification"]["components_missed"], 1);
  EXPECT_EQ(record["verification"]["topology_equal"], false);
  EXPECT_EQ(record["certificate"]["verdict"], "different");
  EXPECT_GT(record["distances"]["mesh_to_isosurface_max_voxels"], 1);
  EXPECT_EQ(record["total_seconds"], 0.5);
  EXPECT_EQ(record["command"]["warm_seconds"], 0.25);
  EXPECT_EQ(record["command"]["version"], "1.0");
}

TEST_F(CommandMesher, FailuresAreToldInOneSentence) {
  const std::string name = "the mesher 'mesher.sh' ";
  EXPECT_EQ(failure("echo first >&2; echo 'no licence found' >&2; exit 3"),
            name + "ended with exit code 3: no licence found");
  EXPECT_EQ(failure("kill -SEGV $$"), name + "was ended by signal 11");
  EXPECT_EQ(failure("sleep 60", 0.2), name + "did not end within 0.2 s and was ended");
  EXPECT_EQ(failure("exit 0"), name + "wrote no mesh");
  EXPECT_TRUE(failure("echo nonsense > \"$3\"").starts_with(name + "wrote a mesh that cannot be read: the file"));
  EXPECT_EQ(failure("echo hello > \"$4\"; \"$6\" mesh \"$1\" --isovalue \"$2\" -o \"$3\" --quiet"),
            name + "wrote a report that is no JSON object");
}

TEST_F(CommandMesher, AProgramThatIsNotThereIsToldOf) {
  Json json = document("exit 0");
  json["variants"][1]["mesher"]["command"][0] = "no-such-mesher-anywhere";
  EXPECT_EQ(run(json).exit_code, 1);
  EXPECT_EQ(records().back()["error"], "the mesher 'no-such-mesher-anywhere' is no program that can be started");
}

TEST_F(CommandMesher, MistakesInTheCommandAreRefused) {
  const auto refusal = [&](const char* pointer, const Json& value) {
    Json json = document("exit 0");
    json["variants"][1]["mesher"][Json::json_pointer(pointer)] = value;
    const ProgramResult result = run(json);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  const auto expect_part = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_part(refusal("/command/1", "{volumes}"), "has an unknown placeholder {volumes}; the nearest known name is");
  expect_part(refusal("/command/3", "out.ply"), "has no argument with {mesh}");
  expect_part(refusal("/command/2", 7), "command/2 (line ");
  expect_part(refusal("/timeout", 0), "must be a number from 0.001");
  expect_part(refusal("/exit_codes", Json::array({300})), "must be an integer from 0 to 255, found 300");
  expect_part(refusal("/mesh_format", "../ply"), "is no extension in small letters");
}

// The memory of a program begins with that of the process that starts it; the launcher's does not.
TEST(ProgramLauncher, TellsThePeakOfTheProgramAlone) {
  ProgramLauncher launcher;
  std::vector<char> ballast(400'000'000, 1);
  const ChildResult result = launcher.run("/bin/sh", {"-c", "echo hello >&2; exit 5"}, 20, nullptr);
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.err, "hello\n");
  EXPECT_LT(result.peak_memory_bytes, 300'000'000);  // the tests themselves take 170 MB with sanitizers
  EXPECT_GT(result.peak_memory_bytes, 100'000);
  EXPECT_EQ(ballast.back(), 1);
}

TEST(ProgramLauncher, EndsTheProgramWhenItIsStopped) {
  ProgramLauncher launcher;
  const std::atomic<bool> stop{true};
  const ChildResult result = launcher.run("/bin/sleep", {"60"}, 60, &stop);
  EXPECT_TRUE(result.is_stopped);
  EXPECT_LT(result.wall_seconds, 30);
  // It can start others afterwards.
  EXPECT_EQ(launcher.run("/bin/sh", {"-c", "exit 0"}, 20, nullptr).exit_code, 0);
}

}  // namespace
}  // namespace deliso::testing
