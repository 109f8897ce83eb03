#include "surface/local_characteristic.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "surface/facet_pairing.h"

namespace deliso {

namespace {

// V - E + F of the simplices of the mesh whose vertices all belong to some tetrahedra. Signs of these change nothing
// else: an umbrella, which is a vertex of the mesh, lies in the star of its vertex, an edge's facets around the edge.
class LocalMesh {
 public:
  LocalMesh(const SignedDelaunay& restricted, std::span<const TetId> tets)
      : restricted_(restricted), delaunay_(restricted.delaunay()) {
    for (const TetId t : tets) {
      for (const VertexId v : delaunay_.vertices(t)) {
        if (!restricted_.is_virtual(v) && !holds(v)) vertices_.push_back({v, t});
      }
    }
  }

  // Twice the characteristic: an edge counts half for each of its two sides.
  [[nodiscard]] std::int64_t doubled_characteristic() {
    std::int64_t doubled = 0;
    for (const auto& [v, t] : vertices_) {
      find_facets_around(v, t);
      doubled += 2 * count_umbrellas(v);
      for (const FacetId f : facets_) doubled += doubled_facet(f, v);
    }
    return doubled;
  }

 private:
  struct Place {
    VertexId vertex;
    TetId tet;  // one that has it
  };

  [[nodiscard]] bool holds(VertexId v) const {
    return std::any_of(vertices_.begin(), vertices_.end(), [v](const Place& place) { return place.vertex == v; });
  }
  [[nodiscard]] bool is_in_mesh(FacetId f) const {
    const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
    return std::none_of(v.begin(), v.end(), [&](VertexId q) { return restricted_.is_virtual(q); });
  }
  void find_facets_around(VertexId v, TetId from);
  [[nodiscard]] std::int64_t count_umbrellas(VertexId v);
  [[nodiscard]] std::int64_t doubled_facet(FacetId f, VertexId at) const;

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  std::vector<Place> vertices_;
  std::vector<TetId> star_;
  std::vector<FacetId> facets_;  // of the mesh around one vertex, seen from above
  std::vector<std::size_t> umbrella_;
};

void LocalMesh::find_facets_around(VertexId v, TetId from) {
  star_.assign(1, from);
  facets_.clear();
  for (std::size_t at = 0; at < star_.size(); ++at) {
    const TetId t = star_[at];
    for (unsigned face = 0; face < 4; ++face) {
      if (delaunay_.vertices(t)[face] == v) continue;
      const TetId next = delaunay_.neighbour(t, face);
      if (std::find(star_.begin(), star_.end(), next) == star_.end()) star_.push_back(next);
      const FacetId f(t, face);
      if (restricted_.is_above(t) && restricted_.is_restricted(f) && is_in_mesh(f)) facets_.push_back(f);
    }
  }
}

// Classes of the facets around v that are joined across edges at v.
std::int64_t LocalMesh::count_umbrellas(VertexId v) {
  umbrella_.resize(facets_.size());
  std::iota(umbrella_.begin(), umbrella_.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (umbrella_[i] != i) i = umbrella_[i];
    return i;
  };
  auto umbrellas = static_cast<std::int64_t>(facets_.size());
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    for (const VertexId third : delaunay_.facet_vertices(facets_[i])) {
      if (third == v) continue;
      const FacetId partner = paired_across(restricted_, facets_[i], third).partner;
      const auto at = std::find(facets_.begin(), facets_.end(), partner);
      if (at == facets_.end()) continue;
      const std::size_t a = root(i), b = root(static_cast<std::size_t>(at - facets_.begin()));
      if (a == b) continue;
      umbrella_[a] = b;
      --umbrellas;
    }
  }
  return umbrellas;
}

// What a facet counts for, with its sides; at one of its vertices only, the first of those that are held.
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

std::int64_t change_of_characteristic(SignedDelaunay& restricted, std::span<const TetId> tets) {
  LocalMesh local(restricted, tets);
  const std::int64_t before = local.doubled_characteristic();
  for (const TetId t : tets) restricted.overturn_sign(t);
  const std::int64_t after = local.doubled_characteristic();
  for (const TetId t : tets) restricted.overturn_sign(t);
  return (after - before) / 2;
}

}  // namespace deliso
