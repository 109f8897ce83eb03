// The minimum cut of a network, found by augmenting flow along shortest paths, all those of one length before longer
// ones (Dinic, Algorithm for solution of a problem of maximum flow in networks with power estimation, 1970).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace deliso {

// Of the nodes below `nodes` some are joined with the source, some with the sink, and some with each other. The cut
// leaves each on the side of the source or on that of the sink, so that the capacities of the arcs from the first to
// the second have the least sum.
class MinimumCut {
 public:
  explicit MinimumCut(std::size_t nodes) : arcs_of_(kFirst + nodes) {}

  void join_source(std::uint32_t node, double capacity) { add_arcs(kSource, kFirst + node, capacity, 0); }
  void join_sink(std::uint32_t node, double capacity) { add_arcs(kFirst + node, kSink, capacity, 0); }
  // The same capacity both ways.
  void join(std::uint32_t a, std::uint32_t b, double capacity) { add_arcs(kFirst + a, kFirst + b, capacity, capacity); }
  // Finds the cut. Of several the one with the fewest nodes on the side of the source.
  void find() {
    reached_by_.assign(arcs_of_.size(), kNone);
    while (finds_levels()) {
      while (finds_path()) send_along();
    }
  }
  // After find().
  [[nodiscard]] bool is_on_source_side(std::uint32_t node) const { return level_[kFirst + node] != kNone; }

 private:
  static constexpr std::uint32_t kSource = 0, kSink = 1, kFirst = 2;
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  struct Arc {
    std::uint32_t to = 0;
    double room = 0;
  };

  // The reverse arc has the next number.
  void add_arcs(std::uint32_t from, std::uint32_t to, double there, double back) {
    arcs_of_[from].push_back(static_cast<std::uint32_t>(arcs_.size()));
    arcs_.push_back({to, there});
    arcs_of_[to].push_back(static_cast<std::uint32_t>(arcs_.size()));
    arcs_.push_back({from, back});
  }

  // The number of arcs with room on the shortest path from the source to each node. Returns whether the sink is
  // reached.
  bool finds_levels() {
    level_.assign(arcs_of_.size(), kNone);
    level_[kSource] = 0;
    std::vector<std::uint32_t> open = {kSource};
    for (std::size_t at = 0; at < open.size(); ++at) {
      for (const std::uint32_t arc : arcs_of_[open[at]]) {
        const auto& [to, room] = arcs_[arc];
        if (!(room > 0) || level_[to] != kNone) continue;
        level_[to] = level_[open[at]] + 1;
        if (to != kSink) open.push_back(to);
      }
    }
    next_.assign(arcs_of_.size(), 0);
    return level_[kSink] != kNone;
  }
  // Walks from level to level until the sink is reached. An arc that leads nowhere is not looked at again: next_.
  bool finds_path() {
    std::uint32_t node = kSource;
    while (node != kSink) {
      if (next_[node] == arcs_of_[node].size()) {
        if (node == kSource) return false;
        node = arcs_[reached_by_[node] ^ 1U].to;
        ++next_[node];
        continue;
      }
      const std::uint32_t arc = arcs_of_[node][next_[node]];
      const auto& [to, room] = arcs_[arc];
      if (room > 0 && level_[to] == level_[node] + 1) {
        reached_by_[to] = arc;
        node = to;
      } else {
        ++next_[node];
      }
    }
    return true;
  }
  void send_along() {
    double flow = std::numeric_limits<double>::infinity();
    const auto for_each_arc = [&](const auto& visit) {
      for (std::uint32_t node = kSink; node != kSource; node = arcs_[reached_by_[node] ^ 1U].to) {
        visit(reached_by_[node]);
      }
    };
    for_each_arc([&](std::uint32_t arc) { flow = std::min(flow, arcs_[arc].room); });
    for_each_arc([&](std::uint32_t arc) {
      arcs_[arc].room -= flow;
      arcs_[arc ^ 1U].room += flow;
    });
  }

  std::vector<Arc> arcs_;
  std::vector<std::vector<std::uint32_t>> arcs_of_;  // of each node
  std::vector<std::uint32_t> level_;                 // of each node; kNone where no path with room leads
  std::vector<std::size_t> next_;                    // of each node: its first arc that may lead on
  std::vector<std::uint32_t> reached_by_;            // of each node on the path at hand: the arc
};

}  // namespace deliso
