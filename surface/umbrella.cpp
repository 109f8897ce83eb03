#include "surface/umbrella.h"

namespace deliso {

UmbrellaShape UmbrellaInspector::inspect(VertexId q) {
  collect(q);
  if (facets_.empty()) return UmbrellaShape::kEmpty;

  // Follow the link from its first edge; it must come back after passing every edge, with one way on at every vertex.
  VertexId at = link_.front().to;
  bool at_infinity = false;
  for (std::size_t passed = 1;; ++passed) {
    at_infinity |= restricted_.is_virtual(at);
    const LinkEdge* next = nullptr;
    for (const LinkEdge& edge : link_) {
      if (edge.from != at) continue;
      if (next != nullptr) return UmbrellaShape::kBroken;
      next = &edge;
    }
    if (next == nullptr) return UmbrellaShape::kBroken;
    if (next == &link_.front()) {
      if (passed != link_.size()) return UmbrellaShape::kBroken;
      return at_infinity ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk;
    }
    if (passed > link_.size()) return UmbrellaShape::kBroken;
    at = next->to;
  }
}

void UmbrellaInspector::collect(VertexId q) {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  seen_.resize(delaunay.tet_slots(), 0);
  ++inspection_;
  star_.clear();
  facets_.clear();
  link_.clear();
  star_.push_back(delaunay.incident_tet(q));
  seen_[star_.front().index()] = inspection_;
  for (std::size_t i = 0; i < star_.size(); ++i) {
    const TetId t = star_[i];
    const auto& v = delaunay.vertices(t);
    for (unsigned face = 0; face < 4; ++face) {
      if (v[face] == q) continue;
      const TetId neighbour = delaunay.neighbour(t, face);
      if (restricted_.is_above(t) && !restricted_.is_above(neighbour)) {
        // The facet is counterclockwise seen from the neighbour, which lies below.
        const auto& slots = kFacetSlots[face];
        const unsigned at = v[slots[0]] == q ? 0 : v[slots[1]] == q ? 1 : 2;
        facets_.emplace_back(t, face);
        link_.push_back({v[slots[(at + 1) % 3]], v[slots[(at + 2) % 3]]});
      }
      if (seen_[neighbour.index()] == inspection_) continue;
      seen_[neighbour.index()] = inspection_;
      star_.push_back(neighbour);
    }
  }
}

}  // namespace deliso
