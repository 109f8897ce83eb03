// What the program knows about itself.
#include "experiments/system/program_info.h"

#include <gtest/gtest.h>

#include <sys/mman.h>

#include <cstring>

namespace deliso {
namespace {

TEST(ProgramInfo, PeakMemoryOfARunForgetsWhatWasGivenBackBeforeIt) {
  constexpr std::size_t kBytes = std::size_t{256} << 20;
  void* const block = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  std::memset(block, 1, kBytes);
  const std::int64_t with = peak_memory_bytes();
  munmap(block, kBytes);
  EXPECT_GT(with, static_cast<std::int64_t>(kBytes));
  constexpr std::int64_t kCountedLater = 1 << 20;        // the system adds pages up in batches
  EXPECT_GE(peak_memory_bytes(), with - kCountedLater);  // a peak stays
  reset_peak_memory();
  const std::int64_t after = peak_memory_bytes();
  if (after >= with) GTEST_SKIP() << "this system does not let a process reset its peak";
  EXPECT_LT(after, with - static_cast<std::int64_t>(kBytes) / 2);
}

}  // namespace
}  // namespace deliso
