#include "delaunay/base/shared_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

// Against std::vector, with elements that own memory.
TEST(SharedArray, IsLikeAVector) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    SharedArray<std::string> array;
    std::vector<std::string> expected;
    for (int step = 0; step < 2000; ++step) {
      const std::string text(rng.below(40), static_cast<char>('a' + rng.below(26)));
      switch (rng.below(8)) {
        case 0:
          expected.resize(rng.below(2 * expected.size() + 3));
          array.resize(expected.size());
          break;
        case 1:
          array.make_room(rng.below(3 * array.size() + 1));
          break;
        case 2: {
          SharedArray<std::string> moved(std::move(array));
          array = std::move(moved);
          break;
        }
        case 3:
          if (expected.empty()) break;
          expected.push_back(expected.front());
          array.push_back(array[0]);
          break;
        default:
          expected.push_back(text);
          array.push_back(text);
      }
      ASSERT_TRUE(std::equal(array.begin(), array.end(), expected.begin(), expected.end())) << "seed " << seed;
    }
  }
}

TEST(SharedArray, GrowsToAtLeastHalfAsMuchAgainWhereRoomIsMade) {
  SharedArray<int> array(100);
  array.make_room(200);
  const int* const data = array.data();
  EXPECT_GE(array.room_left(), 100u);
  array.make_room(150);
  EXPECT_EQ(array.data(), data);
  array.make_room(201);
  EXPECT_GE(array.room_left(), 200u);
}

// From a few bytes to many huge pages, copied by several threads.
TEST(SharedArray, KeepsWhatItHoldsHoweverLargeItGrows) {
  constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15u;
  SharedArray<std::uint64_t> array;
  for (const std::size_t size : {10u, 300'000u, 300'001u, 700'000u, 3'000'000u}) {
    array.reserve(size, 3);
    while (array.size() < size) array.push_back(array.size() * kStep);
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(array[i], i * kStep) << size;
  }
  array.make_room(5'000'000, 2);
  array.resize(4'000'000);
  for (std::size_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], i < 3'000'000 ? i * kStep : 0) << i;
}

TEST(SharedArray, TakesInWhatViewsOnSeveralThreadsAppend) {
  constexpr std::size_t kViews = 4, kEach = 5000;
  SharedArray<std::string> array(10);
  array.make_room(10 + kViews * kEach);
  std::vector<SharedArray<std::string>> views;
  for (std::size_t k = 0; k < kViews; ++k) views.emplace_back(array, Range{10 + k * kEach, 10 + (k + 1) * kEach});
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < kViews; ++k) {
      threads.emplace_back([&view = views[k], k] {
        for (std::size_t i = 0; i < 1000 * k; ++i) view.push_back(std::to_string(view.size()) + " of a long text");
        view[k] = "mine";  // what was there before is everybody's
      });
    }
  }
  std::vector<Range> skipped;
  for (auto& view : views) skipped.push_back(array.take_in(view));
  ASSERT_EQ(array.size(), 10 + 3 * kEach + 3000);
  EXPECT_EQ(skipped[0].first, skipped[0].last);
  for (std::size_t k = 1; k < kViews; ++k) {
    EXPECT_EQ(skipped[k].first, 10 + (k - 1) * kEach + 1000 * (k - 1));
    EXPECT_EQ(skipped[k].last, 10 + k * kEach);
    for (std::size_t i = skipped[k].first; i < skipped[k].last; ++i) ASSERT_EQ(array[i], "");
    for (std::size_t i = skipped[k].last; i < skipped[k].last + 1000 * k; ++i) {
      ASSERT_EQ(array[i], std::to_string(i) + " of a long text");
    }
    EXPECT_EQ(array[k], "mine");
  }
}

// No leak and nothing destroyed twice, which sanitizers would see.
TEST(SharedArray, AViewThatIsNotTakenInEndsWhatItAppended) {
  SharedArray<std::string> array(3);
  array.make_room(10);
  {
    SharedArray<std::string> view(array, {5, 9});
    for (int i = 0; i < 4; ++i) view.push_back("a text that does not fit into the string itself");
    EXPECT_THROW(view.push_back("one more"), InternalError);
  }
  EXPECT_EQ(array.size(), 3u);
  EXPECT_THROW(SharedArray<std::string>(array, {2, 5}), InternalError);
  EXPECT_THROW(SharedArray<std::string>(array, {3, 1000}), InternalError);
}

}  // namespace
}  // namespace deliso
