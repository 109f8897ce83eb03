// The replay oracle: rebuilds every state of a run from its trace alone, with sets and maps, and nothing of the
// program's own structures.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace deliso {

class TraceReplay {
 public:
  using Json = nlohmann::ordered_json;
  using Tet = std::array<int, 4>;       // sorted
  using Triangle = std::array<int, 3>;  // sorted
  using Corners = std::array<int, 3>;   // in their order, the least first

  std::vector<std::array<double, 3>> points;       // of stage 1
  std::map<Tet, bool> above;                       // the sign of each tetrahedron
  std::map<Triangle, std::vector<double>> hits;    // of each facet that has some
  std::vector<std::array<double, 3>> mesh_points;  // of stage 2
  std::multiset<Corners> triangles;

  void play(const Json& event) {
    const std::string kind = event.at("e");
    if (kind == "initial") begin(event);
    if (kind == "insert") insert(event);
    if (kind == "mesh" || kind == "shape") take_mesh(event);
    if (kind == "refine") refine(event);
    if (kind == "restart") {
      mesh_points = first_points_;
      triangles = first_triangles_;
    }
    if (kind == "refined" && event.at("triangles").is_array()) take_mesh(event);
  }

  // Those between tetrahedra of different signs.
  [[nodiscard]] std::set<Triangle> restricted() const {
    std::map<Triangle, int> sides;  // above minus below
    for (const auto& [tet, is_above] : above) {
      for (const Triangle& f : facets_of(tet)) sides[f] += is_above ? 1 : -1;
    }
    std::set<Triangle> found;
    for (const auto& [f, sum] : sides) {
      if (sum == 0) found.insert(f);
    }
    return found;
  }

  template <std::size_t N>
  static std::array<int, N> sorted(std::array<int, N> v) {
    std::sort(v.begin(), v.end());
    return v;
  }
  static Corners rotated(Corners c) {
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  }

 private:
  static std::array<Triangle, 4> facets_of(const Tet& t) {
    return {Triangle{t[1], t[2], t[3]}, Triangle{t[0], t[2], t[3]}, Triangle{t[0], t[1], t[3]},
            Triangle{t[0], t[1], t[2]}};
  }

  void begin(const Json& event) {
    points = event.at("points").get<std::vector<std::array<double, 3>>>();
    const std::string signs = event.at("above");
    for (std::size_t i = 0; i < signs.size(); ++i) above[sorted(event.at("tets").at(i).get<Tet>())] = signs[i] == '1';
    take_hits(event);
  }

  void take_hits(const Json& event) {
    for (const Json& facet : event.at("facets")) {
      const Triangle f = sorted(Triangle{facet.at(0), facet.at(1), facet.at(2)});
      const auto found = facet.at(3).get<std::vector<double>>();
      if (found.empty()) {
        hits.erase(f);
      } else {
        hits[f] = found;
      }
    }
  }

  void insert(const Json& event) {
    const int v = event.at("v");
    if (v != static_cast<int>(points.size())) throw std::runtime_error("vertices are not numbered in order");
    points.push_back(event.at("p").get<std::array<double, 3>>());
    std::map<Triangle, int> times;
    for (const Json& gone : event.at("gone")) {
      const Tet tet = sorted(gone.get<Tet>());
      if (above.erase(tet) == 0) throw std::runtime_error("a tetrahedron is gone that was not there");
      for (const Triangle& f : facets_of(tet)) ++times[f];
    }
    const std::string signs = event.at("above");
    std::size_t i = 0;
    for (const auto& [f, count] : times) {
      if (count == 2) hits.erase(f);
      if (count == 1) above[sorted(Tet{f[0], f[1], f[2], v})] = signs.at(i++) == '1';
    }
    if (i != signs.size()) throw std::runtime_error("the rim has another number of facets");
    take_hits(event);
  }

  void take_mesh(const Json& event) {
    mesh_points = event.at("points").get<std::vector<std::array<double, 3>>>();
    triangles.clear();
    for (const Json& t : event.at("triangles")) triangles.insert(rotated(t.get<Corners>()));
    first_points_ = mesh_points;
    first_triangles_ = triangles;
  }

  void refine(const Json& event) {
    const int v = event.at("v");
    if (v != static_cast<int>(mesh_points.size())) throw std::runtime_error("mesh vertices are not numbered in order");
    mesh_points.push_back(event.at("p").get<std::array<double, 3>>());
    for (const Json& gone : event.at("gone")) {
      const auto found = triangles.find(rotated(gone.get<Corners>()));
      if (found == triangles.end()) throw std::runtime_error("a triangle of E was not there");
      triangles.erase(found);
    }
    const auto rim = event.at("rim").get<std::vector<int>>();
    const std::size_t edges = event.at("closed").get<bool>() ? rim.size() : rim.size() - 1;
    for (std::size_t i = 0; i < edges; ++i) triangles.insert(rotated({v, rim[i], rim[(i + 1) % rim.size()]}));
  }

  std::vector<std::array<double, 3>> first_points_;
  std::multiset<Corners> first_triangles_;
};

}  // namespace deliso
