#include "surface/link_change.h"

#include <algorithm>

namespace deliso {

bool LinkChange::keeps_cycle(VertexId newest) const {
  if (gained_count_ == 0 || gained_count_ > kMost) return false;
  const std::optional<Ends> ends = ends_of_lost_path();
  if (!ends) return false;
  // As many steps as there are edges, each the only one from where it begins, and the end only at last: so the path
  // passes each edge once, and no vertex twice.
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
