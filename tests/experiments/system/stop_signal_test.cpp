// SIGINT and SIGTERM where there is no partial result: exit code 3, one line on stderr, no file.
#include "experiments/system/stop_signal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// Without a delay a signal comes while the first slices are written; later ones find a part of the file on disk.
TEST(StopSignal, GenerateLeavesNoFile) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const int milliseconds : {0, 300}) {
      const TemporaryFolder folder;
      // Large enough to keep any machine busy for much longer than the delay.
      const ProgramResult result =
          run_deliso({"generate", "gyroid", "--size", "900", "-o", folder / "v.nrrd"},
                     SignalAfter{signal, std::chrono::milliseconds(milliseconds), folder.path()});
      EXPECT_EQ(result.exit_code, 3) << result.err << " after " << result.seconds << " s";
      EXPECT_EQ(result.err, "deliso: stopped by a signal, no file was written\n");
      EXPECT_EQ(result.out, "");
      EXPECT_TRUE(folder.names().empty()) << folder.names().front();
    }
  }
}

TEST(StopSignal, RenderLeavesNoFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_deliso({"generate", "gyroid", "--size", "40", "-o", folder / "v.nrrd"}).exit_code, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    // Eight million rays, one after the other.
    const ProgramResult result = run_deliso({"render", folder / "v.nrrd", "--isovalue", "0.1", "-o", folder / "p.png",
                                             "--size", "4000x2000", "--samples", "1", "--threads", "1"},
                                            SignalAfter{signal, std::chrono::milliseconds(400)});
    EXPECT_EQ(result.exit_code, 3) << result.err << " after " << result.seconds << " s";
    EXPECT_EQ(result.err, "deliso: stopped by a signal, no file was written\n");
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(folder.names().size(), 1u);
  }
}

TEST(StopSignalDeathTest, WithoutAHoldTheProgramEndsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          stop_at_signals();
          std::raise(signal);
        },
        ::testing::ExitedWithCode(3), "^deliso: stopped by a signal, no file was written\n$");
  }
}

// Signals in a row are one request; a later one ends the program.
TEST(StopSignalDeathTest, OnlyALaterSignalEndsARunWithPartialResults) {
  for (const auto& [first, second] : {std::pair{SIGTERM, SIGTERM}, {SIGINT, SIGTERM}}) {
    const auto raise_two = [a = first, b = second] {
      const std::atomic<bool>& stop = catch_stop_signals();
      std::raise(a);
      std::raise(b);
      std::raise(a);
      if (!stop.load()) std::exit(1);
    };
    EXPECT_EXIT(
        {
          raise_two();
          std::exit(44);
        },
        ::testing::ExitedWithCode(44), "^$");
    EXPECT_EXIT(
        {
          raise_two();
          std::this_thread::sleep_for(std::chrono::milliseconds(1050));
          std::raise(SIGTERM);
        },
        ::testing::KilledBySignal(SIGTERM), "^$");
  }
}

TEST(StopSignalDeathTest, AHoldKeepsTheSignalWaiting) {
  EXPECT_EXIT(
      {
        stop_at_signals();
        const StopHold hold;
        hold.check();
        std::raise(SIGTERM);
        try {
          hold.check();
        } catch (const Stopped&) {
          std::exit(42);
        }
      },
      ::testing::ExitedWithCode(42), "^$");
}

TEST(StopSignalDeathTest, AfterTheResultIsInPlaceTheProgramGoesOn) {
  EXPECT_EXIT(
      {
        stop_at_signals();
        {
          StopHold hold;
          hold.finish();
        }
        std::raise(SIGINT);
        std::exit(43);
      },
      ::testing::ExitedWithCode(43), "^$");
}

}  // namespace
}  // namespace deliso::testing
