#include "surface/intersection/box_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "surface/search/kd_order.h"
#include "tests/support/random_boxes.h"

namespace deliso {
namespace {

using testing::have_common_point;
using testing::random_boxes;

Vec3 centre(const Box3& box) { return 0.5 * (box.low + box.high); }

Box3 box_of_all(const std::vector<Box3>& boxes) {
  Box3 all;
  for (const Box3& box : boxes) {
    if (box.low.x > box.high.x) continue;  // empty
    all.extend(box.low);
    all.extend(box.high);
  }
  return all;
}

std::vector<std::uint32_t> order_of(const std::vector<Box3>& boxes, int threads = 1) {
  const CentreLattice lattice(box_of_all(boxes));
  std::vector<LatticePlace> places;
  for (std::size_t i = 0; i < boxes.size(); ++i) places.push_back(lattice.place(centre(boxes[i]), i));
  return kd_order(
      std::move(places), [&](std::uint32_t i) { return centre(boxes[i]); }, threads);
}

// Parts as the header says: the left part has as many leaves as the largest power of two below all. No centre of the
// left part lies farther along the longest side than one of the right part, except within the bits that the split of
// few positions ignores.
void expect_halves(const std::vector<Box3>& boxes, const std::vector<std::uint32_t>& order, std::size_t first,
                   std::size_t last) {
  if (last - first <= 8) return;
  std::size_t left = 8;
  while (2 * left < last - first) left *= 2;
  Box3 all;
  for (std::size_t i = first; i < last; ++i) all.extend(centre(boxes[order[i]]));
  const Vec3 size = all.size();
  const double longest = std::max({size.x, size.y, size.z}), tolerance = 1e-6 * longest;
  bool is_parted = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (size[k] < longest - tolerance) continue;
    double left_most = -1e300, right_least = 1e300;
    for (std::size_t i = first; i < last; ++i) {
      const double x = centre(boxes[order[i]])[k];
      if (i < first + left) left_most = std::max(left_most, x);
      if (i >= first + left) right_least = std::min(right_least, x);
    }
    is_parted = is_parted || left_most <= right_least + tolerance;
  }
  EXPECT_TRUE(is_parted) << first << " to " << last;
  expect_halves(boxes, order, first, first + left);
  expect_halves(boxes, order, first + left, last);
}

TEST(HalvingOrder, PartsAlongTheLongestSideInCompleteHalvesForAnyNumberOfThreads) {
  for (const std::size_t count : {0U, 1U, 8U, 9U, 31U, 32U, 33U, 64U, 65U, 100U, 257U, 1000U, 5000U}) {
    SCOPED_TRACE(count);
    Rng rng(count + 1);
    std::vector<Box3> boxes = random_boxes(rng, count, 0.1);
    const std::vector<std::uint32_t> order = order_of(boxes);
    std::vector<std::uint32_t> sorted = order, all(count);
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0U);
    ASSERT_EQ(sorted, all) << "each thing once";
    expect_halves(boxes, order, 0, count);
    EXPECT_EQ(order_of(boxes, 3), order);
  }
}

// Where all centres, or most of them, are the same there is no pivot that parts them.
TEST(HalvingOrder, OrdersWhatStandsInOnePlace) {
  for (const std::size_t others : {0U, 1U, 40U}) {
    Rng rng(others + 1);
    std::vector<Box3> boxes = random_boxes(rng, others, 0.1);
    Box3 point;
    point.extend(Vec3{0.5, 0.5, 0.5});
    boxes.resize(others + 2000, point);
    std::vector<std::uint32_t> order = order_of(boxes), all(boxes.size());
    expect_halves(boxes, order, 0, boxes.size());
    std::sort(order.begin(), order.end());
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
  }
}

// Boxes of a crowd in a corner of a lattice too coarse for it are parted as well as any.
TEST(HalvingOrder, PartsACrowdInOneStepOfTheLattice) {
  Rng rng(3);
  std::vector<Box3> boxes = random_boxes(rng, 3000, 0.1);
  for (Box3& box : boxes) {
    box.low = 1e-12 * box.low;
    box.high = 1e-12 * box.high;
  }
  Box3 far;
  far.extend(Vec3{1, 1, 1});
  boxes.resize(boxes.size() + 3000, far);
  const std::vector<std::uint32_t> order = order_of(boxes);
  // Of the crowd eight times eight in a row take up a small part of it.
  double sum = 0;
  int rows = 0;
  for (std::size_t i = 0; i + 64 <= order.size(); i += 64) {
    Box3 row;
    for (std::size_t k = i; k < i + 64; ++k) row.extend(centre(boxes[order[k]]));
    if (row.high.x > 0.5) continue;
    sum += norm(row.size());
    ++rows;
  }
  ASSERT_GT(rows, 40);
  EXPECT_LT(sum / rows, 0.8e-12);
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

template <class Real>
Pairs found_pairs(const std::vector<Box3>& ordered, const std::vector<LabelRow>& labels, std::size_t& most_tasks) {
  Pairs found;
  const BoxPairs<Real> pairs(ordered.size(), box_of_all(ordered).low, labels,
                             [&](std::size_t i) { return ordered[i]; });
  const auto tasks = pairs.tasks();
  most_tasks = std::max(most_tasks, tasks.size());
  for (const auto& task : tasks) {
    pairs.for_each(task, [&](std::uint32_t i, std::uint32_t j) { found.emplace_back(std::minmax(i, j)); });
  }
  std::sort(found.begin(), found.end());
  return found;
}

using Labels = LabelRow::Labels;

// Few labels, or many, void ones among them; boxes in a row often have one in common.
std::vector<Labels> random_labels(Rng& rng, std::size_t count) {
  std::vector<Labels> all(count);
  const std::uint64_t kinds = rng.below(2) == 0 ? 10 : 1000;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint32_t& label : all[i]) {
      label = static_cast<std::uint32_t>(rng.below(kinds)) | (rng.below(4) == 0 ? LabelRow::kVoid : 0);
    }
    if (i % 8 != 0 && rng.below(3) > 0) all[i][rng.below(3)] = all[i / 8 * 8][i / 8 % 3];
  }
  return all;
}

bool have_common_label(const Labels& s, const Labels& t) {
  return std::any_of(s.begin(), s.end(), [&](std::uint32_t label) {
    return label < LabelRow::kVoid && std::find(t.begin(), t.end(), label) != t.end();
  });
}

// By brute force; boxes on a coarse grid touch in faces, edges and corners.
TEST(BoxPairs, FindsThePairsOfBruteForce) {
  std::size_t most_tasks = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const bool is_large = seed % 20 == 0;
    std::vector<Box3> boxes = random_boxes(rng, is_large ? 2500 : rng.below(200), is_large ? 0.05 : 0.2);
    for (Box3& box : boxes) {
      if (seed % 2 == 0) break;
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::floor(16 * box.low[k]) - 8;
        box.high[k] = std::floor(16 * box.high[k]) - 8;
      }
    }
    std::vector<Box3> ordered;
    for (const std::uint32_t i : order_of(boxes)) ordered.push_back(boxes[i]);
    for (Box3& box : ordered) {
      if (rng.below(10) == 0) box = {};  // a place that is free
    }
    const std::vector<Labels> labels = random_labels(rng, ordered.size());
    std::vector<LabelRow> rows((ordered.size() + 7) / 8);
    for (std::size_t i = 0; i < ordered.size(); ++i) rows[i / 8].set(i % 8, labels[i]);
    Pairs expected;
    for (std::uint32_t i = 0; i < ordered.size(); ++i) {
      for (std::uint32_t j = i + 1; j < ordered.size(); ++j) {
        if (have_common_label(labels[i], labels[j])) continue;
        if (have_common_point(ordered[i], ordered[j])) expected.emplace_back(i, j);
      }
    }
    EXPECT_EQ(found_pairs<double>(ordered, rows, most_tasks), expected);
    const Pairs found = found_pairs<float>(ordered, rows, most_tasks);
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "a pair twice";
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
    // What is found besides is apart by less than the rounding to floats.
    Pairs others;
    std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(others));
    for (const auto& [i, j] : others) {
      const Box3 &a = ordered[i], &b = ordered[j];
      EXPECT_FALSE(have_common_label(labels[i], labels[j]));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(std::max(a.low[k] - b.high[k], b.low[k] - a.high[k]), 1e-6);
      }
    }
  }
  EXPECT_GT(most_tasks, 20U);
}

}  // namespace
}  // namespace deliso
