#include "surface/restricted/umbrella.h"

#include <array>

namespace deliso {

namespace {

constexpr std::uint32_t kLargestWalk = 32;  // of restricted facets

// The slot of v, which is one of the four vertices. Computed by a sum without branches, because the slot is
// unpredictable.
unsigned slot_of(const std::array<VertexId, 4>& tet, VertexId v) {
  return static_cast<unsigned>(tet[1] == v) + 2 * static_cast<unsigned>(tet[2] == v) +
         3 * static_cast<unsigned>(tet[3] == v);
}
// Which of a facet's three slots holds q.
unsigned place_of(const std::array<VertexId, 4>& tet, const unsigned (&slots)[3], VertexId q) {
  return static_cast<unsigned>(tet[slots[1]] == q) + 2 * static_cast<unsigned>(tet[slots[2]] == q);
}

}  // namespace

UmbrellaShape shape_by_walk(const SignedDelaunay& restricted, VertexId q, FacetId first, std::uint32_t size) {
  if (size == 0) return UmbrellaShape::kEmpty;
  if (size > kLargestWalk) return UmbrellaShape::kBroken;
  const Tetrahedralization& delaunay = restricted.delaunay();
  std::array<VertexId, kLargestWalk> link;
  std::uint32_t passed = 0;
  bool at_infinity = false;
  FacetId facet = first;
  for (;;) {
    // The facet's link edge runs from one vertex to the next, counterclockwise seen from below the isovalue.
    const auto& slots = kFacetSlots[facet.face()];
    const auto& v = delaunay.vertices(facet.tet());
    const unsigned at = place_of(v, slots, q);
    const VertexId from = v[slots[(at + 1) % 3]];
    const VertexId to = v[slots[(at + 2) % 3]];
    bool is_repeated = false;
    for (std::uint32_t i = 0; i < passed; ++i) is_repeated |= link[i] == from;
    if (is_repeated) return UmbrellaShape::kBroken;
    link[passed++] = from;
    at_infinity |= restricted.is_virtual(from);

    // The next facet also has the edge from q to `to`: rotate around this edge on the side above, until the sign
    // changes.
    TetId t = facet.tet();
    VertexId behind = from;
    for (;;) {
      const auto& tet = delaunay.vertices(t);
      const unsigned face = slot_of(tet, behind);
      const FacetId mirror = delaunay.mirror(FacetId(t, face));
      if (!restricted.is_above(mirror.tet())) {
        facet = FacetId(t, face);
        break;
      }
      // The fourth vertex of t becomes the vertex behind in the next tetrahedron.
      behind.value = tet[0].value ^ tet[1].value ^ tet[2].value ^ tet[3].value ^ q.value ^ to.value ^ behind.value;
      t = mirror.tet();
    }
    if (facet == first) break;
    if (passed == size) return UmbrellaShape::kBroken;
  }
  if (passed != size) return UmbrellaShape::kBroken;
  return at_infinity ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk;
}

UmbrellaShape UmbrellaInspector::inspect(VertexId q) {
  collect(q);
  if (facets_.empty()) return UmbrellaShape::kEmpty;

  // Follow the link from its first edge. It must return to its start after all edges, with one next edge at every
  // vertex.
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
  facets_.clear();
  link_.clear();
  star_.resize(64);
  std::size_t star_size = 1;
  star_.front() = delaunay.incident_tet(q);
  seen_[star_.front().index()] = inspection_;
  for (std::size_t i = 0; i < star_size; ++i) {
    if (star_size + 3 > star_.size()) star_.resize(2 * star_.size());
    const TetId t = star_[i];
    const auto& v = delaunay.vertices(t);
    const unsigned slot = slot_of(v, q);
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned face = k + static_cast<unsigned>(k >= slot);  // all but the one opposite q
      const TetId neighbour = delaunay.neighbour(t, face);
      if (restricted_.falls_through(FacetId(t, face))) {
        // The facet is counterclockwise seen from the neighbour, which lies below.
        const auto& slots = kFacetSlots[face];
        const unsigned at = place_of(v, slots, q);
        facets_.emplace_back(t, face);
        link_.push_back({v[slots[(at + 1) % 3]], v[slots[(at + 2) % 3]]});
      }
      // Whether it is new is unpredictable: it is always appended, and overwritten unless it is new.
      std::uint32_t& seen = seen_[neighbour.index()];
      star_[star_size] = neighbour;
      star_size += static_cast<std::size_t>(seen != inspection_);
      seen = inspection_;
    }
  }
  star_.resize(star_size);
}

}  // namespace deliso
