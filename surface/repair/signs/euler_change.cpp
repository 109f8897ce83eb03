#include "surface/repair/signs/euler_change.h"
#include "delaunay/base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "surface/extract/facet_pairing.h"

namespace deliso {

namespace {

// A hash set of tetrahedra. Mostly there are few, but hundreds meet at a vertex where samples lie in planes far apart.
class TetSet {
 public:
  void clear() {
    std::fill(table_.begin(), table_.end(), kFree);
    size_ = 0;
  }
  // Returns whether t was not in the set yet.
  bool insert(TetId t) {
    if (2 * ++size_ > table_.size()) grow();
    std::uint32_t& slot = slot_of(t.value);
    if (slot == t.value) {
      --size_;
      return false;
    }
    slot = t.value;
    return true;
  }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;

  // The slot of a number, or the free slot where it belongs.
  std::uint32_t& slot_of(std::uint32_t number) {
    const std::size_t last = table_.size() - 1;
    std::size_t at = (number * std::size_t{0x9E3779B97F4A7C15} >> 32) & last;
    while (table_[at] != kFree && table_[at] != number) at = (at + 1) & last;
    return table_[at];
  }
  void grow() {
    const std::vector<std::uint32_t> old = std::exchange(table_, std::vector(2 * table_.size(), kFree));
    for (const std::uint32_t number : old) {
      if (number != kFree) slot_of(number) = number;
    }
  }

  std::vector<std::uint32_t> table_ = std::vector(64, kFree);  // size: a power of two, at most half of it used
  std::size_t size_ = 0;
};

// Whether a flip of the tetrahedron's sign only moves the mesh from one part of its boundary to the other, as at a
// simple point of a digital image (Kong and Rosenfeld, Digital topology, 1989). Certain only when true. The condition:
// one, two or three of its facets are in the mesh (a disk); every edge on the rim of this disk has exactly one further
// facet; and no other facet is at an edge of the tetrahedron. So an edge keeps its two facets, or gains or loses both.
// A vertex keeps its umbrellas; only the common vertex of three facets gains or loses one, together with its three
// edges.
class SimpleTet {
 public:
  explicit SimpleTet(const SignedDelaunay& restricted) : restricted_(restricted), delaunay_(restricted.delaunay()) {}

  [[nodiscard]] bool operator()(TetId t) const {
    const auto& v = delaunay_.vertices(t);
    if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted_.is_virtual(q); })) return false;
    std::array<bool, 4> in_mesh{};
    for (unsigned face = 0; face < 4; ++face) in_mesh[face] = restricted_.is_restricted(FacetId(t, face));
    const auto count = std::count(in_mesh.begin(), in_mesh.end(), true);
    if (count == 0 || count == 4) return false;
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = i + 1; j < 4; ++j) {
        if (facets_around(t, i, j) != (in_mesh[i] || in_mesh[j] ? 2 : 0)) return false;
      }
    }
    return true;
  }

 private:
  static constexpr int kMany = 3;

  // The number of facets of the mesh at the common edge of faces i and j of t; kMany for more than two, or if there are
  // virtual vertices around the edge.
  [[nodiscard]] int facets_around(TetId t, unsigned i, unsigned j) const {
    int count = 0;
    bool is_above = restricted_.is_above(t);
    FacetId out(t, i);
    VertexId third = delaunay_.vertices(t)[j];  // the vertex of `out` that is not on the edge
    for (;;) {
      const FacetId in = delaunay_.mirror(out);
      if (restricted_.is_above(in.tet()) != is_above && ++count == kMany) return kMany;
      if (in.tet() == t) return count;
      is_above = restricted_.is_above(in.tet());
      out = facet_opposite(delaunay_, in.tet(), third);
      third = delaunay_.vertices(in.tet())[in.face()];
      if (restricted_.is_virtual(third)) return kMany;
    }
  }

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
};

// V - E + F of those simplices of the mesh whose vertices all belong to a tetrahedron. The tetrahedron's sign
// influences no other simplex: the umbrellas of a vertex (the vertices of the mesh) lie in its star, the facets at an
// edge around the edge.
class LocalMesh {
 public:
  LocalMesh(const SignedDelaunay& restricted, TetId t) : restricted_(restricted), delaunay_(restricted.delaunay()) {
    for (const VertexId v : delaunay_.vertices(t)) {
      if (!restricted_.is_virtual(v)) add(v, t);
    }
  }

  // Twice the characteristic: each of the two sides of an edge counts half.
  [[nodiscard]] std::int64_t doubled_characteristic() {
    std::int64_t doubled = 0;
    for (const Star& star : vertices_) {
      const VertexId v = star.vertex;
      find_facets_around(star);
      doubled += 2 * count_umbrellas(v);
      for (const FacetId f : facets_) doubled += doubled_facet(f, v);
    }
    return doubled;
  }

 private:
  struct Star {
    VertexId vertex;
    std::size_t first, last;  // range of the tetrahedra around it in stars_
  };

  [[nodiscard]] bool holds(VertexId v) const {
    return std::any_of(vertices_.begin(), vertices_.end(), [v](const Star& star) { return star.vertex == v; });
  }
  [[nodiscard]] bool is_in_mesh(FacetId f) const {
    const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
    return std::none_of(v.begin(), v.end(), [&](VertexId q) { return restricted_.is_virtual(q); });
  }
  void add(VertexId v, TetId from);
  void find_facets_around(const Star& star);
  [[nodiscard]] std::int64_t count_umbrellas(VertexId v);
  [[nodiscard]] std::int64_t doubled_facet(FacetId f, VertexId at) const;

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  std::vector<Star> vertices_;
  std::vector<TetId> stars_;
  TetSet in_star_;
  std::vector<FacetId> facets_;  // of the mesh around one vertex, seen from above
  DisjointSets umbrellas_;       // of these
};

// Adds a vertex and the tetrahedra around it, one of which is `from`.
void LocalMesh::add(VertexId v, TetId from) {
  const std::size_t first = stars_.size();
  in_star_.clear();
  in_star_.insert(from);
  stars_.push_back(from);
  for (std::size_t at = first; at < stars_.size(); ++at) {
    const TetId t = stars_[at];
    for (unsigned face = 0; face < 4; ++face) {
      if (delaunay_.vertices(t)[face] == v) continue;
      const TetId next = delaunay_.neighbour(t, face);
      if (in_star_.insert(next)) stars_.push_back(next);
    }
  }
  vertices_.push_back({v, first, stars_.size()});
}

void LocalMesh::find_facets_around(const Star& star) {
  facets_.clear();
  for (std::size_t at = star.first; at < star.last; ++at) {
    const TetId t = stars_[at];
    if (!restricted_.is_above(t)) continue;
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId f(t, face);
      if (delaunay_.vertices(t)[face] == star.vertex || !restricted_.is_restricted(f) || !is_in_mesh(f)) continue;
      facets_.push_back(f);
    }
  }
}

// Counts the classes of facets around v that are joined across edges at v.
std::int64_t LocalMesh::count_umbrellas(VertexId v) {
  umbrellas_.reset(facets_.size());
  auto umbrellas = static_cast<std::int64_t>(facets_.size());
  for (std::uint32_t i = 0; i < facets_.size(); ++i) {
    for (const VertexId third : delaunay_.facet_vertices(facets_[i])) {
      if (third == v) continue;
      const FacetId partner = paired_across(restricted_, facets_[i], third).partner;
      const auto at = std::find(facets_.begin(), facets_.end(), partner);
      if (at == facets_.end()) continue;
      if (umbrellas_.unite(i, static_cast<std::uint32_t>(at - facets_.begin()))) --umbrellas;
    }
  }
  return umbrellas;
}

// The contribution of a facet and its sides. It is counted at one vertex only: the first of its vertices that belongs
// to the tetrahedron.
std::int64_t LocalMesh::doubled_facet(FacetId f, VertexId at) const {
  const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
  if (*std::find_if(v.begin(), v.end(), [&](VertexId q) { return holds(q); }) != at) return 0;
  std::int64_t doubled = 0;
  bool is_whole = true;
  for (unsigned i = 0; i < 3; ++i) {
    is_whole = is_whole && holds(v[i]);
    if (!holds(v[(i + 1) % 3]) || !holds(v[(i + 2) % 3])) continue;
    doubled -= is_in_mesh(paired_across(restricted_, f, v[i]).partner) ? 1 : 2;
  }
  return is_whole ? doubled + 2 : doubled;
}

}  // namespace

std::int64_t euler_change(SignedDelaunay& restricted, TetId t) {
  if (SimpleTet(restricted)(t)) return 0;  // nearly always
  LocalMesh local(restricted, t);
  const std::int64_t before = local.doubled_characteristic();
  restricted.flip_sign(t);
  const std::int64_t after = local.doubled_characteristic();
  restricted.flip_sign(t);
  return (after - before) / 2;
}

}  // namespace deliso
