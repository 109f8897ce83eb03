// The same runs in one folder at the same time: one process makes them, the other is refused, and no lock outlives its
// process.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/runs/run_lock.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(RunLock, HoldsTheRunsOfItsShardAndNoOthers) {
  const TemporaryFolder folder;
  constexpr std::size_t kRuns = 12;
  const auto is_free = [&folder](const Shard& shard) {
    try {
      const RunLock lock(folder.path(), shard, kRuns);
    } catch (const InputError&) {
      return false;
    }
    return true;
  };
  const std::vector<Shard> shards = {{1, 1}, {1, 2}, {2, 2}, {1, 4}, {2, 4}, {3, 4}, {2, 3}, {11, 20}, {15, 20}};
  for (const Shard& held : shards) {
    SCOPED_TRACE(std::to_string(held.index) + "/" + std::to_string(held.count));
    std::optional<RunLock> lock;
    lock.emplace(folder.path(), held, kRuns);
    for (const Shard& other : shards) {
      bool share = false;
      for (std::size_t run = 0; run < kRuns; ++run) {
        share = share || (run % held.count == held.index - 1 && run % other.count == other.index - 1);
      }
      EXPECT_EQ(is_free(other), !share) << other.index << "/" << other.count;
    }
    lock.reset();
    EXPECT_TRUE(is_free({1, 1}));
  }
}

class RunLockedFolder : public ::testing::Test {
 protected:
  explicit RunLockedFolder(int repeats = 20) {
    Json document = small_document();
    document["repeats"] = repeats;
    write_file(folder_ / "small.json", json_text(document));
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more = {},
                                  std::optional<SignalAfter> signal = std::nullopt) const {
    std::vector<std::string> arguments = {"run", folder_ / "small.json", "--out", folder_ / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_deliso(arguments, std::move(signal));
  }

  TemporaryFolder folder_;
};

class LongRunLockedFolder : public RunLockedFolder {
 protected:
  LongRunLockedFolder() : RunLockedFolder(1000) {}
};

TEST_F(LongRunLockedFolder, ASecondProcessIsRefusedUntilTheFirstHasEndedEvenIfKilled) {
  const auto first = std::async(std::launch::async,
                                [this] { return run({}, SignalAfter{.signal = SIGKILL, .file = folder_ / "enough"}); });
  while (read_file(folder_ / "out/records.jsonl").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--resume"}, {"--shard", "2/2"}}) {
    const ProgramResult second = run(more);
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_EQ(std::count(second.err.begin(), second.err.end(), '\n'), 1) << second.err;
    EXPECT_MESSAGE(second.err, "another process is making these runs in " + (folder_ / "out"));
  }
  write_file(folder_ / "enough", "now");
  first.wait();
  EXPECT_NO_THROW(RunLock(folder_ / "out", {1, 1}, 4000));
}

TEST_F(RunLockedFolder, ShardsShareItAtTheSameTime) {
  std::vector<std::future<ProgramResult>> shards;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    shards.push_back(std::async(std::launch::async, [this, shard] { return run({"--shard", shard}); }));
  }
  for (std::future<ProgramResult>& shard : shards) {
    const ProgramResult result = shard.get();
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  // Every run is recorded, and none twice.
  const ProgramResult table = run_deliso({"table", folder_ / "out"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_EQ(table.err, "");
  EXPECT_EQ(table.out.find("Remarks"), std::string::npos) << table.out;
}

}  // namespace
}  // namespace deliso::testing
