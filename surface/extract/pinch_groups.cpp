#include "surface/extract/pinch_groups.h"

#include <unordered_map>

#include "delaunay/base/disjoint_sets.h"

namespace deliso {

std::vector<std::size_t> groups_that_matter(std::span<const PinchGroup> groups,
                                            const std::function<void(std::size_t, const VertexVisit&)>& visit_around,
                                            const std::function<bool(std::uint32_t)>& is_wanted) {
  std::unordered_map<std::uint32_t, std::uint32_t> group_of;  // of each copy
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    for (const Copy& copy : groups[i]) group_of[copy.vertex] = i;
  }
  // Sets of groups that depend on each other.
  DisjointSets sets(groups.size());
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    visit_around(i, [&](std::uint32_t v) {
      if (const auto other = group_of.find(v); other != group_of.end()) sets.unite(i, other->second);
    });
  }
  std::vector<bool> matters(groups.size(), false);
  for (const auto& [v, i] : group_of) {
    if (is_wanted(v)) matters[sets.find(i)] = true;
  }
  std::vector<std::size_t> chosen;
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    if (matters[sets.find(i)]) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace deliso
