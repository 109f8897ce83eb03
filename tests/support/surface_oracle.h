// Slow second opinions on the restricted Delaunay triangulation and on meshes: long doubles, maps and plain scans.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "surface/mesh/surface_mesh.h"
#include "surface/restricted/signed_delaunay.h"
#include "surface/restricted/umbrella.h"
#include "tests/support/topology_mesh_check.h"

namespace deliso::testing {

using LongVec3 = std::array<long double, 3>;

// Center of the circumball by Cramer's rule in long doubles, and how well conditioned that was: |det| / (lengths)^3.
struct LongCenter {
  Vec3 center;
  double condition = 0;
};
inline LongCenter long_circumcenter(const std::array<Vec3, 4>& p) {
  std::array<LongVec3, 3> row{};
  LongVec3 right{};
  long double lengths = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[i][axis] = static_cast<long double>(p[i + 1][axis]) - static_cast<long double>(p[0][axis]);
      right[i] += row[i][axis] * row[i][axis] / 2;
    }
    lengths *= std::sqrt(2 * right[i]);
  }
  const auto det = [](const LongVec3& a, const LongVec3& b, const LongVec3& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const long double d = det(row[0], row[1], row[2]);
  LongCenter result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<LongVec3, 3> replaced = row;
    for (std::size_t i = 0; i < 3; ++i) replaced[i][axis] = right[i];
    const long double offset = det(replaced[0], replaced[1], replaced[2]) / d;
    result.center[axis] = static_cast<double>(static_cast<long double>(p[0][axis]) + offset);
  }
  result.condition = static_cast<double>(std::abs(d) / lengths);
  return result;
}

inline std::array<Vec3, 4> corners_of(const Tetrahedralization& delaunay, TetId t) {
  const auto& v = delaunay.vertices(t);
  return {delaunay.point(v[0]), delaunay.point(v[1]), delaunay.point(v[2]), delaunay.point(v[3])};
}

// Names that do not depend on the order of construction.
using FacetName = std::array<std::uint32_t, 3>;
using TetName = std::array<std::uint32_t, 4>;

inline FacetName name_of(const Tetrahedralization& delaunay, FacetId f) {
  const auto v = delaunay.facet_vertices(f);
  FacetName name = {v[0].value, v[1].value, v[2].value};
  std::sort(name.begin(), name.end());
  return name;
}
inline TetName name_of(const Tetrahedralization& delaunay, TetId t) {
  const auto& v = delaunay.vertices(t);
  TetName name = {v[0].value, v[1].value, v[2].value, v[3].value};
  std::sort(name.begin(), name.end());
  return name;
}

inline std::map<TetName, bool> signs_by_name(const SignedDelaunay& restricted) {
  std::map<TetName, bool> signs;
  for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
    const TetId t(i);
    if (restricted.delaunay().is_live(t)) signs[name_of(restricted.delaunay(), t)] = restricted.is_above(t);
  }
  return signs;
}

// All restricted facets, those with a virtual vertex included.
inline std::set<FacetName> restricted_by_name(const SignedDelaunay& restricted) {
  std::set<FacetName> names;
  for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
    const TetId t(i);
    if (!restricted.delaunay().is_live(t)) continue;
    for (unsigned face = 0; face < 4; ++face) {
      if (restricted.is_restricted(FacetId(t, face))) names.insert(name_of(restricted.delaunay(), FacetId(t, face)));
    }
  }
  return names;
}

// Edges with an odd number of restricted facets around them.
inline std::size_t odd_edges(const SignedDelaunay& restricted) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const FacetName& f : restricted_by_name(restricted)) {
    ++count[{f[0], f[1]}];
    ++count[{f[1], f[2]}];
    ++count[{f[0], f[2]}];
  }
  return static_cast<std::size_t>(
      std::count_if(count.begin(), count.end(), [](const auto& entry) { return entry.second % 2 != 0; }));
}

// The umbrella shape from the definition: the link of q is one cycle.
inline UmbrellaShape brute_umbrella(const SignedDelaunay& restricted, const std::set<FacetName>& facets, VertexId q) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> link;
  for (const FacetName& f : facets) {
    if (std::find(f.begin(), f.end(), q.value) == f.end()) continue;
    std::vector<std::uint32_t> rest;
    std::copy_if(f.begin(), f.end(), std::back_inserter(rest), [&](std::uint32_t v) { return v != q.value; });
    link[rest[0]].push_back(rest[1]);
    link[rest[1]].push_back(rest[0]);
  }
  if (link.empty()) return UmbrellaShape::kEmpty;
  bool has_virtual = false;
  for (const auto& [v, others] : link) {
    if (others.size() != 2) return UmbrellaShape::kBroken;
    has_virtual |= restricted.is_virtual(VertexId(v));
  }
  std::set<std::uint32_t> reached{link.begin()->first};
  std::vector<std::uint32_t> open{link.begin()->first};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const std::uint32_t v : link[at]) {
      if (reached.insert(v).second) open.push_back(v);
    }
  }
  if (reached.size() != link.size()) return UmbrellaShape::kBroken;
  return has_virtual ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk;
}

// What is wrong with the arrays of a surface mesh, in words; empty when nothing is.
inline std::string surface_mesh_defect(const SurfaceMesh& mesh) {
  if (mesh.neighbours.size() != mesh.triangles.size()) return "neighbours and triangles differ in number";
  std::vector<bool> used(mesh.points.size(), false);
  std::map<std::pair<std::uint32_t, std::uint32_t>, TriangleSide> side_of;  // of each directed edge
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.triangles[t][i] >= mesh.points.size()) return "triangle " + std::to_string(t) + " out of range";
      used[mesh.triangles[t][i]] = true;
      side_of[{mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3]}] = 4 * t + i;
    }
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const auto twin = side_of.find({mesh.triangles[t][(i + 2) % 3], mesh.triangles[t][(i + 1) % 3]});
      const TriangleSide expected = twin == side_of.end() ? kNoSide : twin->second;
      if (mesh.neighbours[t][i] != expected) return "neighbour of triangle " + std::to_string(t) + " is another one";
    }
  }
  if (std::find(used.begin(), used.end(), false) != used.end()) return "a vertex without triangles";
  return test::mesh_facts(mesh.triangles).defect;
}

}  // namespace deliso::testing
