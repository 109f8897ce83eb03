#include "experiments/system/child_program.h"

#include <gtest/gtest.h>

#include <string>

#include "delaunay/base/stopwatch.h"

namespace deliso {
namespace {

TEST(ChildProgram, GivesItsOutputAndExitCode) {
  const auto shell = find_program({"no-such-program-anywhere", "sh"});
  ASSERT_TRUE(shell);
  const ChildResult result = run_child(*shell, {"-c", "echo \"$1\"; echo dropped >&2; exit 7", "name", "a b 'c'"}, 60);
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(result.out, "a b 'c'\n");
  EXPECT_FALSE(result.is_timed_out);
}

// More than a pipe holds at a time.
TEST(ChildProgram, ReadsLongOutput) {
  const ChildResult result = run_child(*find_program({"sh"}), {"-c", "head -c 3000000 /dev/zero"}, 60);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.size(), 3'000'000U);
}

// Also what it has started in turn.
TEST(ChildProgram, EndsWhatTakesTooLong) {
  const Stopwatch watch;
  const ChildResult result = run_child(*find_program({"sh"}), {"-c", "echo begun; sleep 600; echo no"}, 0.2);
  EXPECT_TRUE(result.is_timed_out);
  EXPECT_EQ(result.out, "begun\n");
  EXPECT_EQ(result.exit_code, 128 + 9);
  EXPECT_LT(watch.seconds(), 60);
}

TEST(ChildProgram, TellsWhatIsNotThere) {
  EXPECT_FALSE(find_program({"no-such-program-anywhere"}));
  EXPECT_EQ(run_child("/no/such/program", {}, 60).exit_code, 127);
}

}  // namespace
}  // namespace deliso
