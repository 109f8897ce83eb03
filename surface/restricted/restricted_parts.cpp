// Parts of RestrictedDelaunay, for several threads.
#include <algorithm>

#include "delaunay/base/parallel.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

namespace {

// The dual edges that an insertion needs on average; with fewer, a part ends sooner.
constexpr std::size_t kEdgesPerInsertion = 4;

}  // namespace

std::vector<std::unique_ptr<RestrictedDelaunay>> RestrictedDelaunay::parts(std::span<const Slab> slabs,
                                                                           std::size_t insertions, int threads) {
  std::vector<std::unique_ptr<RestrictedDelaunay>> parts;
  if (guards_ > 0 || insertions == 0) return parts;
  const std::vector<PartRoom> rooms = delaunay_.make_rooms(slabs, insertions, threads);
  if (rooms.empty()) return parts;
  const std::size_t count = slabs.size(), edges = dual_edges_.size();
  const std::size_t wanted = kEdgesPerInsertion * insertions + kFewestEdgesLeft;
  const std::size_t least_free = free_edges_.size() / count;
  const std::size_t created = wanted > least_free ? wanted - least_free : 0;
  make_room(rooms.back(), edges + count * created, threads);
  forget_facets_gone();
  const auto first_free = [&](std::size_t k) {
    return free_edges_.begin() + static_cast<std::ptrdiff_t>(k * free_edges_.size() / count);
  };
  for (std::size_t k = 0; k < count; ++k) {
    const EdgeRoom room{{edges + k * created, edges + (k + 1) * created}, {first_free(k), first_free(k + 1)}};
    parts.push_back(std::unique_ptr<RestrictedDelaunay>(new RestrictedDelaunay(*this, rooms[k], room)));
  }
  free_edges_.clear();
  return parts;
}

// A freed slot may be reused by any part: so a part must not look there for the stored facet of a vertex.
void RestrictedDelaunay::forget_facets_gone() {
  for (std::size_t v = 0; v < umbrellas_.size(); ++v) {
    FacetId& facet = umbrellas_[v].facet;
    if (facet.is_none()) continue;
    const auto& corners = delaunay_.vertices(facet.tet());
    const bool is_there =
        delaunay_.is_live(facet.tet()) && std::find(corners.begin(), corners.end(), VertexId(v)) != corners.end();
    if (!is_there) facet = FacetId();
  }
}

// Two arrays at the same time: most of the time goes into waiting for fresh pages.
void RestrictedDelaunay::make_room(const PartRoom& last, std::size_t edges, int threads) {
  const int threads_each = (threads + 1) / 2;
  run_tasks(2, threads, [&](std::size_t task) {
    if (task == 0) {
      dual_edges_.make_room(edges, threads_each);
      touches_.make_room(last.vertices.last, threads_each);
      umbrellas_.make_room(last.vertices.last, threads_each);
    } else {
      tets_.make_room(last.tets.last, threads_each);
      sign_.make_room(last.tets.last, threads_each);
    }
  });
}

RestrictedDelaunay::RestrictedDelaunay(RestrictedDelaunay& whole, const PartRoom& room, const EdgeRoom& edges)
    : SignedDelaunay(whole, room),
      rule_(whole.rule_),
      observer_(whole.observer_),
      tets_(whole.tets_, room.tets),
      touches_(whole.touches_, room.vertices),
      stamp_(whole.stamp_),
      umbrellas_(whole.umbrellas_, room.vertices),
      dual_edges_(whole.dual_edges_, edges.edges),
      free_edges_(edges.free),
      is_part_(true) {}

std::vector<VertexId> RestrictedDelaunay::join(std::span<const std::unique_ptr<RestrictedDelaunay>> parts) {
  for (const auto& part : parts) {
    delaunay_.join(part->delaunay_);
    sign_.take_in(part->sign_);
    tets_.take_in(part->tets_);
    touches_.take_in(part->touches_);
    umbrellas_.take_in(part->umbrellas_);
    const Range skipped = dual_edges_.take_in(part->dual_edges_);
    free_edges_.insert(free_edges_.end(), part->free_edges_.begin(), part->free_edges_.end());
    for (std::size_t e = skipped.first; e < skipped.last; ++e) free_edges_.emplace_back(e);
    stamp_ = std::max(stamp_, part->stamp_);
    counters_ += part->counters_;
    hits_against_signs_ += part->hits_against_signs_;
    restricted_seconds_ += part->restricted_seconds_;
  }
  std::vector<VertexId> renamed = delaunay_.finish_join();
  rename(renamed);
  if (observer_ != nullptr) observer_->renamed(renamed);
  return renamed;
}

void RestrictedDelaunay::rename(std::span<const VertexId> renamed) {
  if (delaunay_.vertex_count() == renamed.size()) return;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v].is_none()) continue;
    touches_[renamed[v].index()] = touches_[v];
    umbrellas_[renamed[v].index()] = umbrellas_[v];
  }
  touches_.resize(delaunay_.vertex_count());
  umbrellas_.resize(delaunay_.vertex_count());
  for (DualEdge& edge : dual_edges_) {
    if ((edge.generation & 1u) == 0) continue;
    for (VertexId& v : edge.vertices) v = renamed[v.index()];
  }
}

}  // namespace deliso
