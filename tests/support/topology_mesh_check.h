// A slow, plain check of a triangle list: is it an oriented manifold, and what are its components? Maps and sets only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "volume/topology/exact_topology.h"

namespace deliso::test {

struct MeshFacts {
  std::string defect;                                             // empty for an oriented manifold
  std::vector<ComponentTopology> components;                      // sorted
  std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary;  // directed edges with one triangle
};

inline MeshFacts mesh_facts(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  MeshFacts facts;
  std::map<std::uint32_t, std::uint32_t> label;  // vertex -> component, by repeated relabelling
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> link;  // vertex -> next vertex around it
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      const std::uint32_t c = t[(i + 2) % 3];
      if (a == b) facts.defect = "a triangle repeats vertex " + std::to_string(a);
      if (++directed[{a, b}] > 1)
        facts.defect = "two triangles run along " + std::to_string(a) + " " + std::to_string(b);
      link[a][b] = c;
    }
  }
  // The link of a vertex is one path or one cycle.
  for (const auto& [vertex, next] : link) {
    std::uint32_t start = next.begin()->first;
    for (const auto& [from, to] : next) {
      const std::uint32_t f = from;
      if (std::none_of(next.begin(), next.end(), [f](const auto& step) { return step.second == f; })) start = f;
    }
    std::uint32_t at = start;
    std::set<std::uint32_t> met;
    while (next.count(at) != 0 && met.insert(at).second) at = next.at(at);
    if (met.size() != next.size()) facts.defect = "vertex " + std::to_string(vertex) + " has two umbrellas";
  }
  // Components: flood over the triangles' edges.
  std::map<std::uint32_t, std::set<std::uint32_t>> neighbours;
  for (const auto& [edge, count] : directed) {
    neighbours[edge.first].insert(edge.second);
    neighbours[edge.second].insert(edge.first);
  }
  std::uint32_t components = 0;
  for (const auto& [vertex, ignored] : neighbours) {
    if (label.count(vertex) != 0) continue;
    std::vector<std::uint32_t> open{vertex};
    label[vertex] = components;
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t other : neighbours[at]) {
        if (label.emplace(other, components).second) open.push_back(other);
      }
    }
    ++components;
  }
  // V - E + F, and boundary cycles.
  facts.components.resize(components);
  for (const auto& [vertex, component] : label) ++facts.components[component].euler_characteristic;
  for (const auto& t : triangles) ++facts.components[label[t[0]]].euler_characteristic;
  std::map<std::uint32_t, std::uint32_t> boundary_next;
  for (const auto& [edge, count] : directed) {
    const bool has_twin = directed.count({edge.second, edge.first}) != 0;
    if (has_twin && edge.first > edge.second) continue;
    --facts.components[label[edge.first]].euler_characteristic;
    if (has_twin) continue;
    facts.boundary.push_back(edge);
    boundary_next[edge.first] = edge.second;
  }
  std::set<std::uint32_t> walked;
  for (const auto& [start, ignored] : boundary_next) {
    if (walked.count(start) != 0) continue;
    ++facts.components[label[start]].boundary_loops;
    for (std::uint32_t at = start; walked.insert(at).second;) at = boundary_next.at(at);
  }
  std::sort(facts.components.begin(), facts.components.end());
  return facts;
}

}  // namespace deliso::test
