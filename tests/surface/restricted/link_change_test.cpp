// Whether a link stays a cycle, against a count of the whole link.
#include "surface/restricted/link_change.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

constexpr std::size_t kNewest = 100;

LinkEdge edge(std::size_t from, std::size_t to) { return {VertexId(from), VertexId(to)}; }

// One edge leaves each vertex, and a walk along them comes back after all.
bool is_cycle(const std::vector<LinkEdge>& link) {
  std::map<std::size_t, std::size_t> next;
  for (const LinkEdge& e : link) next[e.from.index()] = e.to.index();
  if (link.empty() || next.size() != link.size()) return false;
  std::set<std::size_t> passed;
  for (std::size_t at = link.front().from.index(); passed.insert(at).second;) {
    if (next.count(at) == 0) return false;
    at = next[at];
    if (at == link.front().from.index()) break;
  }
  return passed.size() == link.size();
}

struct Exchange {
  LinkChange change;
  std::vector<LinkEdge> link;  // afterwards
};
// The cycle 0, 1, ... without the edges that leave some vertices, with other edges in their place.
Exchange exchanged(std::size_t size, const std::set<std::size_t>& lost, const std::vector<LinkEdge>& gained) {
  Exchange exchange;
  exchange.change.clear();
  for (std::size_t v = 0; v < size; ++v) {
    const LinkEdge e = edge(v, (v + 1) % size);
    if (lost.count(v) != 0) {
      exchange.change.lose(e);
    } else {
      exchange.link.push_back(e);
    }
  }
  for (const LinkEdge& e : gained) {
    exchange.change.gain(e);
    exchange.link.push_back(e);
  }
  return exchange;
}

TEST(LinkChange, KnowsWhatInsertionsUsuallyDo) {
  const VertexId newest(kNewest);
  // An edge is split; a path of two and of three edges is replaced by the new vertex; a vertex is cut off.
  EXPECT_TRUE(exchanged(6, {2}, {edge(2, kNewest), edge(kNewest, 3)}).change.keeps_cycle(newest));
  EXPECT_TRUE(exchanged(6, {2, 3}, {edge(kNewest, 4), edge(2, kNewest)}).change.keeps_cycle(newest));
  EXPECT_TRUE(exchanged(6, {5, 0, 1}, {edge(5, kNewest), edge(kNewest, 2)}).change.keeps_cycle(newest));
  EXPECT_TRUE(exchanged(6, {1, 2}, {edge(1, 3)}).change.keeps_cycle(newest));
  // The path goes round a vertex of the old one, too.
  EXPECT_TRUE(exchanged(6, {1, 2}, {edge(1, kNewest), edge(kNewest, 2), edge(2, 3)}).change.keeps_cycle(newest));
}

TEST(LinkChange, KnowsWhatBreaksLinks) {
  const VertexId newest(kNewest);
  EXPECT_FALSE(exchanged(6, {}, {edge(2, kNewest), edge(kNewest, 3)}).change.keeps_cycle(newest));
  EXPECT_FALSE(exchanged(6, {2}, {}).change.keeps_cycle(newest));
  EXPECT_FALSE(exchanged(6, {2}, {edge(2, kNewest)}).change.keeps_cycle(newest));
  EXPECT_FALSE(exchanged(6, {2}, {edge(3, kNewest), edge(kNewest, 2)}).change.keeps_cycle(newest));  // the wrong way
  EXPECT_FALSE(exchanged(6, {2}, {edge(2, 5), edge(5, 3)}).change.keeps_cycle(newest));  // through another part of it
  EXPECT_FALSE(exchanged(6, {2}, {edge(2, 3), edge(kNewest, 7), edge(7, kNewest)}).change.keeps_cycle(newest));
  EXPECT_FALSE(exchanged(6, {2}, {edge(2, kNewest), edge(kNewest, 3), edge(3, 3)}).change.keeps_cycle(newest));
}

// Small links, exchanged at random: sure only when the whole link is a cycle.
TEST(LinkChange, IsRightWheneverItIsSure) {
  std::size_t kept = 0, missed = 0;
  Rng rng(5);
  for (int run = 0; run < 300000; ++run) {
    const std::size_t size = 3 + rng.below(4);
    std::set<std::size_t> lost;
    const std::size_t first = rng.below(size);
    for (std::size_t count = rng.below(size); count > 0; --count) lost.insert((first + count) % size);
    if (rng.below(4) == 0) lost.insert(rng.below(size));
    const auto any_vertex = [&] { return rng.below(3) == 0 ? kNewest : rng.below(size); };
    std::vector<LinkEdge> gained;
    for (std::size_t count = rng.below(5); count > 0; --count) {
      gained.push_back(gained.empty() || rng.below(4) == 0 ? edge(any_vertex(), any_vertex())
                                                           : edge(gained.back().to.index(), any_vertex()));
    }
    const Exchange exchange = exchanged(size, lost, gained);
    const bool found = exchange.change.keeps_cycle(VertexId(kNewest));
    const bool expected = is_cycle(exchange.link);
    ASSERT_TRUE(!found || expected) << run;
    kept += found ? 1 : 0;
    missed += expected && !found ? 1 : 0;
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(missed, 0u);  // several paths at once, say
}

TEST(LinkChange, KnowsTheLinkOfANewVertex) {
  const auto is_virtual = [](VertexId v) { return v.index() == 50; };
  const auto judged = [&](const std::vector<LinkEdge>& link, std::size_t size) {
    return exchanged(0, {}, link).change.is_new_cycle(size, is_virtual);
  };
  EXPECT_TRUE(judged({edge(1, 2), edge(3, 1), edge(2, 3)}, 3));
  EXPECT_FALSE(judged({edge(1, 2), edge(3, 1), edge(2, 3)}, 4));  // there is more
  EXPECT_FALSE(judged({edge(1, 2), edge(2, 50), edge(50, 1)}, 3));
  EXPECT_FALSE(judged({edge(1, 2), edge(2, 1), edge(3, 4), edge(4, 3)}, 4));  // two cycles
  EXPECT_FALSE(judged({edge(1, 2), edge(2, 3)}, 2));
  EXPECT_FALSE(judged({edge(1, 2), edge(2, 3), edge(3, 1), edge(1, 2)}, 4));
  EXPECT_FALSE(judged({}, 0));
  // More than is noted.
  std::vector<LinkEdge> large;
  for (std::size_t v = 0; v < 40; ++v) large.push_back(edge(v, (v + 1) % 40));
  EXPECT_FALSE(judged(large, 40));
}

}  // namespace
}  // namespace deliso
