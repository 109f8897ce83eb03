// The first half of an insertion: which tetrahedra are in conflict with the point.
#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/bowyer_watson.h"

namespace deliso {

TetId BowyerWatson::locate(const Vec3& p, TetId hint) const { return visibility_walk(*this, filter_, p, hint); }

TetId BowyerWatson::locate_moved(const Vec3& p, const Signs& signs, TetId hint) const {
  return visibility_walk_moved(*this, filter_, p, signs, hint);
}

void BowyerWatson::append_passed_moved(const Vec3& a, const Vec3& b, const Signs& signs, TetId from,
                                       std::vector<Passage>& passed) const {
  deliso::append_passed_moved(*this, filter_, a, b, signs, from, passed);
}

bool BowyerWatson::in_conflict(TetId t, const Vec3& p) const { return conflicts(t, p, VertexId(points_.size())); }

bool BowyerWatson::conflicts(TetId t, const Vec3& p, VertexId p_rank) const {
  // A ghost's ball is the half-space beyond its hull facet; on the facet's plane, it is the disk in which that plane
  // cuts the ball of the tetrahedron inside.
  if (is_ghost(t)) {
    const auto& v = vertices(t);
    const double side = filter_.orient(point(v[0]), point(v[1]), point(v[2]), p);
    if (side != 0) return side > 0;
    t = neighbour(t, 3);
  }
  const auto& v = vertices(t);
  const std::array<Vec3, 4> tet = {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
  const double inside = insphere(tet[0], tet[1], tet[2], tet[3], p);
  if (inside != 0) return inside > 0;
  return perturbed_insphere(
      tet, {perturbation_rank(v[0]), perturbation_rank(v[1]), perturbation_rank(v[2]), perturbation_rank(v[3])}, p,
      p_rank);
}

std::optional<VertexId> BowyerWatson::find_conflicts(const Vec3& p, TetId start) {
  DELISO_CHECK(box_.contains(p), "the point lies in the box");
  DELISO_CHECK(region_size_ == 0, "no other cavity is open");
  DELISO_CHECK(start.index() < tets_.size() && is_live(start), "the search starts from a live tetrahedron");
  const VertexId p_rank(points_.size());
  pending_ = p;
  if (slab_) {
    find_conflicts_of_part(p, start);
    return std::nullopt;
  }
  // In conflict with the newest vertex p means strictly inside (or beyond a hull facet): then p is no duplicate.
  if (conflicts(start, p, p_rank)) {
    grow_region<false>(p, p_rank, start);
    return std::nullopt;
  }
  return find_conflicts_from_located(p, p_rank, locate(p, start));
}

std::optional<VertexId> BowyerWatson::find_conflicts_from_located(const Vec3& p, VertexId p_rank, TetId located) {
  // The tetrahedron that contains p is in conflict with it, unless p is one of its vertices.
  if (!is_ghost(located)) {
    for (const VertexId v : vertices(located)) {
      if (point(v) == p) return v;
    }
  }
  if (slab_) {
    grow_region_of_part(p, p_rank, located);
  } else {
    grow_region<false>(p, p_rank, located);
  }
  return std::nullopt;
}

// The caller of a part names a tetrahedron in conflict: a walk might read what other parts are changing.
void BowyerWatson::find_conflicts_of_part(const Vec3& p, TetId start) {
  const VertexId p_rank(points_.size());
  is_blocked_ = !lies_within(*slab_, start) || !slab_->contains(p) || !conflicts(start, p, p_rank);
  if (!is_blocked_) grow_region_of_part(p, p_rank, start);
}

void BowyerWatson::grow_region_of_part(const Vec3& p, VertexId p_rank, TetId first) {
  is_blocked_ = false;
  grow_region<true>(p, p_rank, first);
  is_blocked_ = is_blocked_ || points_.room_left() == 0 || rim_size_ > region_size_ + tets_left();
  if (is_blocked_) abandon_cavity();
}

template <bool kIsPart>
void BowyerWatson::grow_region(const Vec3& p, VertexId p_rank, TetId first) {
  region_size_ = 0;
  rim_size_ = 0;
  rows_.start(p, points_.size());
  rows_.reserve_more(4);
  reserve_more();
  for (const VertexId v : vertices(first)) {
    if (v != kInfiniteVertex) rows_.add(v, point(v));
  }
  region_[region_size_++] = first;
  set_mark(first, kInside);
  for (std::uint32_t i = 0; i < region_size_; ++i) {
    if (kIsPart && is_blocked_) break;
    const bool is_full = region_size_ + 4 > region_.size() || rim_size_ + 4 > rim_.size();
    if (is_full) [[unlikely]] {
      reserve_more();
    }
    rows_.reserve_more(4);
    test_neighbours<kIsPart>(i, p, p_rank);
  }
  for (const TetId t : conflict_region()) set_mark(t, kUnknown);
  for (const FacetId f : rim()) {
    if (!kIsPart || mark(f.tet()) != kUnknown) set_mark(f.tet(), kUnknown);
  }
}

void BowyerWatson::reserve_more() {
  // One tetrahedron adds at most four to each.
  if (region_size_ + 4 > region_.size()) [[unlikely]] {
    region_.resize(2 * region_.size() + 64);
    region_corners_.resize(region_.size());
  }
  if (rim_size_ + 4 > rim_.size()) [[unlikely]] {
    rim_.resize(2 * rim_.size() + 64);
    rim_from_.resize(rim_.size());
  }
}

// The outcome of a test is unpredictable, and a mispredicted branch would cost more than the test. So results are
// appended without branches: each is written beyond the end, and the end moves by 0 or 1. (Frozen tetrahedra are rare.
// They are not marked, because two parts may read one at the same time.)
template <bool kIsPart>
void BowyerWatson::test_neighbours(std::uint32_t i, const Vec3& p, VertexId p_rank) {
  const TetId t = region_[i];
  const auto& v = vertices(t);
  const Corners corners = {rows_.find(v[0]), rows_.find(v[1]), rows_.find(v[2]),
                           v[3] == kInfiniteVertex ? LiftedRows::kInfinite : rows_.find(v[3])};
  region_corners_[i] = corners;
  // Fetch what the next round will read.
  if (i + 1 < region_size_) {
    for (const FacetId mirror : tets_[region_[i + 1].index()].mirrors) {
      prefetch(FacetId(mirror.value & kMirrorMask).tet());
    }
  }

  // Separate the neighbours to be tested from those already marked.
  const std::array<FacetId, 4> mirrors = tets_[t.index()].mirrors;
  std::array<Untested, 4> untested{};
  unsigned untested_count = 0;
  std::uint32_t rim_size = rim_size_;
  FacetId* const rim = rim_.data();
  std::uint32_t* const rim_from = rim_from_.data();
  for (unsigned face = 0; face < 4; ++face) {
    const FacetId mirror(mirrors[face].value & kMirrorMask);
    const std::uint32_t known = mark(mirror.tet());
    untested[untested_count] = {mirror, face};
    untested_count += static_cast<unsigned>(known == kUnknown);
    rim[rim_size] = mirror;
    rim_from[rim_size] = 4 * i + face;
    rim_size += static_cast<std::uint32_t>(known == kOutside);
  }

  rim_size_ = rim_size;
  test_unknown_neighbours<kIsPart>(i, std::span(untested).first(untested_count), p, p_rank);
}

template <bool kIsPart>
void BowyerWatson::test_unknown_neighbours(std::uint32_t i, std::span<const Untested> untested, const Vec3& p,
                                           VertexId p_rank) {
  const Corners corners = region_corners_[i];
  std::uint32_t rim_size = rim_size_;
  std::uint32_t region_size = region_size_;
  // A neighbour has the same vertices but one, so half of its determinant is that of this tetrahedron: the
  // minors of two rows serve for the two faces opposite the other two.
  const auto rows = [&](unsigned slot) -> const LiftedRow& { return rows_.row(corners[slot]); };
  const std::array<RowMinors, 2> minors = {RowMinors(rows(2), rows(3)), RowMinors(rows(0), rows(1))};
  const std::array<double, 2> products = {rows(2).w() * rows(3).w(), rows(0).w() * rows(1).w()};
  const std::array<double, 2> greatest = {std::max(rows(2).w(), rows(3).w()), std::max(rows(0).w(), rows(1).w())};
  for (const auto& [mirror, face] : untested) {
    const TetId outside = mirror.tet();
    const VertexId far = vertices(outside)[mirror.face()];
    const LiftedRow& row = rows_.row(far == kInfiniteVertex ? LiftedRows::kInfinite : rows_.add(far, point(far)));
    const LiftedRow& partner = rows(face ^ 1u);
    // The far vertex replaces vertex `face`. This reverses the orientation, so a positive determinant means inside. The
    // row stands before its partner, which is a swap when the face is odd.
    const double det = determinant(RowMinors(row, partner), minors[face >> 1]);
    const bool certain = is_certain(det, products[face >> 1] * (row.w() * partner.w()),
                                    std::max(greatest[face >> 1], std::max(row.w(), partner.w())));
    bool inside = (det > 0) != ((face & 1u) != 0);
    if (!certain) [[unlikely]] {
      inside = conflicts(outside, p, p_rank);
    }
    if (kIsPart && is_frozen(mirror)) [[unlikely]] {
      is_blocked_ = is_blocked_ || inside;
      rim_[rim_size] = mirror;
      rim_from_[rim_size] = 4 * i + face;
      ++rim_size;
      continue;
    }
    // Two faces may have the same neighbour: then it is marked by now.
    const bool is_new = mark(outside) == kUnknown;
    add_mark(outside, inside ? kInside : kOutside);
    region_[region_size] = outside;
    region_size += static_cast<std::uint32_t>(inside && is_new);
    rim_[rim_size] = mirror;
    rim_from_[rim_size] = 4 * i + face;
    rim_size += static_cast<std::uint32_t>(!inside);
  }
  region_size_ = region_size;
  rim_size_ = rim_size;
}

}  // namespace deliso
