#include "surface/restricted/link_change.h"

#include <algorithm>

namespace deliso {

bool LinkChange::keeps_cycle(VertexId newest) const {
  if (gained_count_ == 2 && lost_count_ <= kMost) {
    // In nearly all cases a path is replaced by two edges that meet at the newest vertex.
    const bool is_swapped = gained_[0].from == newest;
    const LinkEdge& to_newest = gained_[is_swapped ? 1 : 0];
    const LinkEdge& from_newest = gained_[is_swapped ? 0 : 1];
    if (to_newest.to == newest && from_newest.from == newest) return was_path(to_newest.from, from_newest.to);
  }
  if (gained_count_ == 0 || gained_count_ > kMost) return false;
  const std::optional<Ends> ends = ends_of_lost_path();
  if (!ends) return false;
  // There are as many steps as edges; each step takes the only edge that begins at its vertex, and the end is reached
  // only with the last. So the path passes each edge once, and no vertex twice.
  VertexId at = ends->first;
  for (std::size_t step = 0; step < gained_count_; ++step) {
    const auto was_passed = [&](const LinkEdge& edge) { return edge.from == at; };
    const bool is_free = step == 0 || at == newest || std::any_of(lost().begin(), lost().end(), was_passed);
    const LinkEdge* const edge = only_edge_from(at);
    if (!is_free || edge == nullptr || at == ends->last) return false;
    at = edge->to;
  }
  return at == ends->last;
}

// Whether the lost edges, which are distinct edges of a cycle, form a path from `first` to `last`. Counted without
// branches: there are few edges, in any order.
bool LinkChange::was_path(VertexId first, VertexId last) const {
  std::size_t joints = 0;
  unsigned begins = 0, ends = 0, passes = 0;
  for (const LinkEdge& edge : lost()) {
    for (const LinkEdge& other : lost()) joints += static_cast<std::size_t>(edge.to == other.from);
    begins += static_cast<unsigned>(edge.from == first);
    ends += static_cast<unsigned>(edge.to == last);
    passes += static_cast<unsigned>(edge.to == first) + static_cast<unsigned>(edge.from == last);
  }
  return joints + 1 == lost_count_ && begins == 1 && ends == 1 && passes == 0;
}

// Edges of a cycle are one path when one of them begins where none ends, and one ends where none begins.
std::optional<LinkChange::Ends> LinkChange::ends_of_lost_path() const {
  if (lost_count_ == 0 || lost_count_ > kMost) return std::nullopt;
  Ends ends;
  unsigned firsts = 0, lasts = 0;
  for (const LinkEdge& edge : lost()) {
    bool is_first = true, is_last = true;
    for (const LinkEdge& other : lost()) {
      is_first &= other.to != edge.from;
      is_last &= other.from != edge.to;
    }
    if (is_first) ends.first = edge.from;
    if (is_last) ends.last = edge.to;
    firsts += is_first ? 1 : 0;
    lasts += is_last ? 1 : 0;
  }
  if (firsts != 1 || lasts != 1) return std::nullopt;
  return ends;
}

const LinkEdge* LinkChange::only_edge_from(VertexId v) const {
  const LinkEdge* found = nullptr;
  for (const LinkEdge& edge : gained()) {
    if (edge.from != v) continue;
    if (found != nullptr) return nullptr;
    found = &edge;
  }
  return found;
}

}  // namespace deliso
