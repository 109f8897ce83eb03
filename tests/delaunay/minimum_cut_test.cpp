#include "delaunay/base/minimum_cut.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

// Small whole capacities: their sums are exact, and many cuts are equal.
struct Network {
  std::uint32_t nodes = 0;
  std::vector<double> from_source, to_sink;
  std::vector<std::vector<double>> between;  // of a pair a < b

  explicit Network(Rng& rng) : nodes(static_cast<std::uint32_t>(1 + rng.below(8))) {
    const auto capacity = [&rng] { return static_cast<double>(rng.below(5)); };
    between.resize(nodes);
    for (std::uint32_t a = 0; a < nodes; ++a) {
      from_source.push_back(capacity());
      to_sink.push_back(capacity());
      for (std::uint32_t b = 0; b < nodes; ++b) between[a].push_back(a < b && rng.below(2) == 0 ? capacity() : 0);
    }
  }
  // What a cut costs, by the side of each node. (Of bits of a number g++ 12.2 at -O1 takes equal ones for unequal.)
  [[nodiscard]] double cost(const std::vector<bool>& is_on_source_side) const {
    double sum = 0;
    for (std::uint32_t a = 0; a < nodes; ++a) {
      sum += is_on_source_side[a] ? to_sink[a] : from_source[a];
      for (std::uint32_t b = a + 1; b < nodes; ++b) {
        if (is_on_source_side[a] != is_on_source_side[b]) sum += between[a][b];
      }
    }
    return sum;
  }
  [[nodiscard]] MinimumCut cut() const {
    MinimumCut cut(nodes);
    for (std::uint32_t a = 0; a < nodes; ++a) {
      cut.join_source(a, from_source[a]);
      cut.join_sink(a, to_sink[a]);
      for (std::uint32_t b = a + 1; b < nodes; ++b) cut.join(a, b, between[a][b]);
    }
    cut.find();
    return cut;
  }
};

TEST(MinimumCut, NoOtherCutIsLess) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    const Network network(rng);
    const MinimumCut cut = network.cut();
    std::vector<bool> found;
    for (std::uint32_t i = 0; i < network.nodes; ++i) found.push_back(cut.is_on_source_side(i));
    const double least = network.cost(found);
    for (unsigned number = 0; number < 1u << network.nodes; ++number) {
      std::vector<bool> side;
      for (std::uint32_t i = 0; i < network.nodes; ++i) side.push_back((number >> i & 1u) != 0);
      const double cost = network.cost(side);
      ASSERT_LE(least, cost) << "seed " << seed << ", side " << number;
      // Of equal ones it has the fewest nodes, which every other one has, too.
      for (std::uint32_t i = 0; i < network.nodes && cost == least; ++i) ASSERT_TRUE(side[i] || !found[i]) << seed;
    }
  }
}

}  // namespace
}  // namespace deliso
