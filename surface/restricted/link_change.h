// How an insertion changes the link of a vertex on the surface. The umbrella stays a disk when a path of the link was
// replaced by another path. This test is much faster than a walk around the whole umbrella.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "delaunay/ids.h"

namespace deliso {

// The edge of a vertex's restricted facet opposite the vertex, oriented as in the facet.
struct LinkEdge {
  VertexId from, to;
};

class LinkChange {
 public:
  void clear() { lost_count_ = gained_count_ = 0; }
  void lose(const LinkEdge& edge) { note(edge, lost_, lost_count_); }
  void gain(const LinkEdge& edge) { note(edge, gained_, gained_count_); }

  // Whether a link that was one cycle is one cycle again. Certain only when true: a path was lost, and a path between
  // the same two ends was gained, through vertices of the lost one and `newest`, which was in no link.
  [[nodiscard]] bool keeps_cycle(VertexId newest) const;
  // Whether the gained edges form one cycle of `size` vertices, none of which is virtual by `is_virtual`. Certain only
  // when true.
  template <class IsVirtual>
  [[nodiscard]] bool is_new_cycle(std::size_t size, const IsVirtual& is_virtual) const;

 private:
  static constexpr std::size_t kMost = 12;  // edges; with more changes the answer is always false
  using Edges = std::array<LinkEdge, kMost>;
  struct Ends {
    VertexId first, last;
  };

  static void note(const LinkEdge& edge, Edges& edges, std::uint32_t& count) {
    if (count < kMost) edges[count] = edge;
    ++count;
  }
  [[nodiscard]] std::span<const LinkEdge> lost() const { return std::span(lost_).first(lost_count_); }
  [[nodiscard]] std::span<const LinkEdge> gained() const { return std::span(gained_).first(gained_count_); }
  [[nodiscard]] bool was_path(VertexId first, VertexId last) const;
  [[nodiscard]] std::optional<Ends> ends_of_lost_path() const;
  [[nodiscard]] const LinkEdge* only_edge_from(VertexId v) const;

  Edges lost_, gained_;
  std::uint32_t lost_count_ = 0, gained_count_ = 0;
};

template <class IsVirtual>
bool LinkChange::is_new_cycle(std::size_t size, const IsVirtual& is_virtual) const {
  if (lost_count_ != 0 || gained_count_ != size || size == 0 || size > kMost) return false;
  VertexId at = gained_[0].from;
  for (std::size_t step = 0; step < size; ++step) {
    const LinkEdge* const edge = only_edge_from(at);
    if (edge == nullptr || is_virtual(at) || (step > 0 && at == gained_[0].from)) return false;
    at = edge->to;
  }
  return at == gained_[0].from;
}

}  // namespace deliso
