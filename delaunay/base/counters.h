// Counters of the ray searches, reported per stage (Dey and Levine, Table 4). Plain data, passed by reference.
#pragma once

#include <cstdint>

namespace deliso {

struct SearchCounters {
  std::uint64_t searches = 0;      // queries made
  std::uint64_t solves = 0;        // cell cubics solved in them
  std::uint64_t searches_hit = 0;  // queries that found at least one hit
  std::uint64_t solves_hit = 0;    // cell cubics solved in those

  SearchCounters& operator+=(const SearchCounters& b) {
    searches += b.searches;
    solves += b.solves;
    searches_hit += b.searches_hit;
    solves_hit += b.solves_hit;
    return *this;
  }
};

}  // namespace deliso
