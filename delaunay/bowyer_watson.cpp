#include "delaunay/bowyer_watson.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/point_location.h"
#include "delaunay/spatial_order.h"

namespace deliso {

namespace {

// Vertex slots of face i, so that with the slot opposite it put before them they make a negative tetrahedron; slot 3,
// where the infinite vertex of a ghost is, comes last.
constexpr unsigned kStarSlots[4][3] = {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}};

// Insertions from reading a point of the input to needing it.
constexpr std::size_t kAhead = 8;

// Positions in `order` of four points that span space, the first among them; none when all points are coplanar.
std::optional<std::array<std::size_t, 4>> find_simplex(std::span<const Vec3> points,
                                                       std::span<const std::uint32_t> order) {
  std::array<std::size_t, 4> simplex{};
  unsigned found = 1;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto corner = [&](unsigned k) -> const Vec3& { return points[order[simplex[k]]]; };
    const Vec3& p = points[order[i]];
    const bool spans = found == 1   ? p != corner(0)
                       : found == 2 ? !collinear(corner(0), corner(1), p)
                                    : orient3d(corner(0), corner(1), corner(2), p) != 0;
    if (!spans) continue;
    simplex[found++] = i;
    if (found == 4) return simplex;
  }
  return std::nullopt;
}

}  // namespace

BowyerWatson::BowyerWatson(const Box3& box) : box_(box), filter_(box) {}

bool BowyerWatson::build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of) {
  clear();
  if (vertex_of != nullptr) vertex_of->clear();
  for (const Vec3& p : points) DELISO_CHECK(box_.contains(p), "every point lies in the box");
  if (points.empty()) return false;

  // Step 1: the insertion order, beginning with four points that span space.
  std::vector<std::uint32_t> order = spatial_order(points);
  const auto simplex = find_simplex(points, order);
  if (!simplex) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>((*simplex)[i]);
    std::rotate(order.begin() + static_cast<std::ptrdiff_t>(i), from, from + 1);
  }

  // Step 2: insert, the vertices numbered in that order for the sake of the caches, the perturbation ordered by input.
  std::vector<VertexId> vertices(points.size());
  insert_all(points, order, vertices);
  // Step 3: number the vertices as the input.
  number_as_input(points, vertices);
  if (vertex_of != nullptr) *vertex_of = std::move(vertices);
  return true;
}

void BowyerWatson::insert_all(std::span<const Vec3> points, std::span<const std::uint32_t> order,
                              std::vector<VertexId>& vertex_of) {
  points_.reserve(points.size());
  incident_.reserve(points.size());
  ranks_.reserve(points.size());
  tets_.reserve(8 * points.size());
  const auto add_vertex = [&](std::uint32_t input) {
    vertex_of[input] = VertexId(points_.size());
    points_.push_back(points[input]);
    incident_.emplace_back();
    ranks_.emplace_back(std::size_t{input});
    return vertex_of[input];
  };
  for (const std::uint32_t input : order.first(4)) add_vertex(input);
  make_first_tet();
  TetId hint(std::size_t{0});
  for (std::size_t i = 4; i < order.size(); ++i) {
    const std::uint32_t input = order[i];
    if (i + kAhead < order.size()) __builtin_prefetch(&points[order[i + kAhead]]);
    // Equal points follow each other by index in the order, so the one that becomes a vertex has the least index.
    const Vec3& p = points[input];
    if (const auto duplicate = find_conflicts_from_located(p, VertexId(input), locate(p, hint))) {
      vertex_of[input] = *duplicate;
      continue;
    }
    star_rim(add_vertex(input));
    hint = created_.front();
  }
  created_.clear();
}

TetId BowyerWatson::locate(const Vec3& p, TetId hint) const { return visibility_walk(*this, filter_, p, hint); }

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
  // In conflict with the newest vertex p means strictly inside (or beyond a hull facet): then p is no duplicate.
  if (conflicts(start, p, p_rank)) {
    grow_region(p, p_rank, start);
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
  grow_region(p, p_rank, located);
  return std::nullopt;
}

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
    const bool is_full = region_size_ + 4 > region_.size() || rim_size_ + 4 > rim_.size();
    if (is_full) [[unlikely]] {
      reserve_more();
    }
    rows_.reserve_more(4);
    test_neighbours(i, p, p_rank);
  }
  for (const TetId t : conflict_region()) set_mark(t, kUnknown);
  for (const FacetId f : rim()) set_mark(f.tet(), kUnknown);
}

void BowyerWatson::reserve_more() {
  // One tetrahedron adds at most four of each.
  if (region_size_ + 4 > region_.size()) [[unlikely]] {
    region_.resize(2 * region_.size() + 64);
    region_corners_.resize(region_.size());
  }
  if (rim_size_ + 4 > rim_.size()) [[unlikely]] {
    rim_.resize(2 * rim_.size() + 64);
    rim_from_.resize(rim_.size());
  }
}

// The outcome of a test is as good as random, and a branch on it would cost more than the test: hence results are
// appended without branches, to the place beyond the end, and the end moves or does not.
void BowyerWatson::test_neighbours(std::uint32_t i, const Vec3& p, VertexId p_rank) {
  const TetId t = region_[i];
  const auto& v = vertices(t);
  const Corners corners = {rows_.find(v[0]), rows_.find(v[1]), rows_.find(v[2]), rows_.find(v[3])};
  region_corners_[i] = corners;
  // Fetch what the next round will read.
  if (i + 1 < region_size_) {
    for (const FacetId mirror : tets_[region_[i + 1].index()].mirrors) {
      prefetch(FacetId(mirror.value & kMirrorMask).tet());
    }
  }

  // Tell the neighbours to be tested from those that are known.
  const std::array<FacetId, 4> mirrors = tets_[t.index()].mirrors;
  std::array<unsigned, 4> untested{};
  unsigned untested_count = 0;
  std::uint32_t rim_size = rim_size_;
  for (unsigned face = 0; face < 4; ++face) {
    const FacetId mirror(mirrors[face].value & kMirrorMask);
    const std::uint32_t known = mark(mirror.tet());
    untested[untested_count] = face;
    untested_count += static_cast<unsigned>(known == kUnknown);
    rim_[rim_size] = mirror;
    rim_from_[rim_size] = 4 * i + face;
    rim_size += static_cast<std::uint32_t>(known == kOutside);
  }

  rim_size_ = rim_size;
  test_unknown_neighbours(i, std::span(untested).first(untested_count), p, p_rank);
}

void BowyerWatson::test_unknown_neighbours(std::uint32_t i, std::span<const unsigned> faces, const Vec3& p,
                                           VertexId p_rank) {
  const std::array<FacetId, 4> mirrors = tets_[region_[i].index()].mirrors;
  const Corners corners = region_corners_[i];
  std::uint32_t rim_size = rim_size_;
  std::uint32_t region_size = region_size_;
  // A neighbour has the same vertices but one, so half of its determinant is that of this tetrahedron: the
  // minors of two rows serve for the two faces opposite the other two.
  const std::array<LiftedRow, 4> rows = {rows_.row(corners[0]), rows_.row(corners[1]), rows_.row(corners[2]),
                                         rows_.row(corners[3])};
  const std::array<RowMinors, 2> minors = {RowMinors(rows[2], rows[3]), RowMinors(rows[0], rows[1])};
  const std::array<double, 2> products = {rows[2].w * rows[3].w, rows[0].w * rows[1].w};
  const std::array<double, 2> greatest = {std::max(rows[2].w, rows[3].w), std::max(rows[0].w, rows[1].w)};
  for (const unsigned face : faces) {
    const FacetId mirror(mirrors[face].value & kMirrorMask);
    const TetId outside = mirror.tet();
    const VertexId far = vertices(outside)[mirror.face()];
    const LiftedRow& row = rows_.row(far == kInfiniteVertex ? LiftedRows::kInfinite : rows_.add(far, point(far)));
    const LiftedRow& partner = rows[face ^ 1u];
    // The far vertex replaces vertex `face`. That turns the tetrahedron over, so a positive determinant means inside;
    // the row stands before its partner, which is a swap when the face is odd.
    const double det = determinant(RowMinors(row, partner), minors[face >> 1]);
    const bool certain = is_certain(det, products[face >> 1] * (row.w * partner.w),
                                    std::max(greatest[face >> 1], std::max(row.w, partner.w)));
    bool inside = (det > 0) != ((face & 1u) != 0);
    if (!certain) [[unlikely]] {
      inside = conflicts(outside, p, p_rank);
    }
    // Two faces may lead to the same neighbour: then it is known by now.
    const bool is_new = mark(outside) == kUnknown;
    set_mark(outside, inside ? kInside : kOutside);
    region_[region_size] = outside;
    region_size += static_cast<std::uint32_t>(inside && is_new);
    rim_[rim_size] = mirror;
    rim_from_[rim_size] = 4 * i + face;
    rim_size += static_cast<std::uint32_t>(!inside);
  }
  region_size_ = region_size;
  rim_size_ = rim_size;
}

VertexId BowyerWatson::fill_cavity() {
  DELISO_CHECK(region_size_ > 0, "find_conflicts has found a region");
  const VertexId v(points_.size());
  points_.push_back(pending_);
  incident_.emplace_back();
  star_rim(v);
  return v;
}

void BowyerWatson::abandon_cavity() {
  region_size_ = 0;
  rim_size_ = 0;
}

void BowyerWatson::take_slots() {
  // The slots of the region first, then free ones, then new ones; what is left of the region is free.
  const std::size_t reused = std::min(region_size_, rim_size_);
  created_.assign(region_.begin(), region_.begin() + static_cast<std::ptrdiff_t>(reused));
  for (std::size_t i = reused; i < region_size_; ++i) {
    tets_[region_[i].index()].vertices[0] = VertexId::none();
    free_.push_back(region_[i]);
  }
  while (created_.size() < rim_size_) {
    if (free_.empty()) {
      DELISO_CHECK(tets_.size() < kMostTets, "there is room for another tetrahedron");
      created_.push_back(TetId(tets_.size()));
      tets_.emplace_back();
    } else {
      created_.push_back(free_.back());
      free_.pop_back();
    }
  }
}

void BowyerWatson::star_rim(VertexId apex) {
  take_slots();
  if (rows_.size() <= SquareEdgeTable::kMostNumbers) {
    edges_.start(rows_.size());
    star_rim(apex, edges_);
  } else {
    HashedEdgeTable edges(3 * std::size_t{rim_size_});
    star_rim(apex, edges);
  }
  incident_[apex.index()] = created_.front();
  region_size_ = 0;
  rim_size_ = 0;
}

template <class EdgeTable>
void BowyerWatson::star_rim(VertexId apex, EdgeTable& edges) {
  // Step 1: one tetrahedron over each facet of the rim, glued to the facet. Each of its other three faces stands on a
  // directed edge of the rim.
  for (std::uint32_t i = 0; i < rim_size_; ++i) {
    const Corners& corners = region_corners_[rim_from_[i] >> 2];
    const auto& slots = kStarSlots[rim_from_[i] & 3u];
    const std::uint32_t x = corners[slots[0]];
    const std::uint32_t y = corners[slots[1]];
    const std::uint32_t z = corners[slots[2]];
    const TetId t = created_[i];
    const FacetId outside = rim_[i];
    Tet& tet = tets_[t.index()];
    tet.vertices = {apex, rows_.id(x), rows_.id(y), rows_.id(z)};
    tet.mirrors[0] = outside;
    tets_[outside.tet().index()].mirrors[outside.face()] = FacetId(t, 0);
    edges.at(y, z) = FacetId(t, 1);
    edges.at(z, x) = FacetId(t, 2);
    edges.at(x, y) = FacetId(t, 3);
    incident_[rows_.id(x).index()] = t;
    incident_[rows_.id(y).index()] = t;
    if (z != LiftedRows::kInfinite) incident_[rows_.id(z).index()] = t;
  }
  // Step 2: the mirror of a face stands on the reversed edge.
  for (std::uint32_t i = 0; i < rim_size_; ++i) {
    const Corners& corners = region_corners_[rim_from_[i] >> 2];
    const auto& slots = kStarSlots[rim_from_[i] & 3u];
    const std::uint32_t x = corners[slots[0]];
    const std::uint32_t y = corners[slots[1]];
    const std::uint32_t z = corners[slots[2]];
    auto& mirrors = tets_[created_[i].index()].mirrors;
    mirrors[1] = edges.at(z, y);
    mirrors[2] = edges.at(x, z);
    mirrors[3] = edges.at(y, x);
  }
}

void BowyerWatson::make_first_tet() {
  // The first tetrahedron, positively oriented, and a ghost on each of its facets.
  std::array<VertexId, 4> v = {VertexId(std::size_t{0}), VertexId(std::size_t{1}), VertexId(std::size_t{2}),
                               VertexId(std::size_t{3})};
  if (orient3d(point(v[0]), point(v[1]), point(v[2]), point(v[3])) < 0) std::swap(v[2], v[3]);
  tets_.resize(5);
  const TetId inner(std::size_t{0});
  tets_[0].vertices = v;
  edges_.start(4);
  for (unsigned face = 0; face < 4; ++face) {
    const TetId t(std::size_t{face} + 1);
    Tet& ghost = tets_[t.index()];
    const auto [a, b, c] = facet_vertices(FacetId(inner, face));
    ghost.vertices = {a, b, c, kInfiniteVertex};
    ghost.mirrors[3] = FacetId(inner, face);
    tets_[0].mirrors[face] = FacetId(t, 3);
    for (unsigned side = 0; side < 3; ++side) {
      edges_.at(ghost.vertices[(side + 1) % 3].value, ghost.vertices[(side + 2) % 3].value) = FacetId(t, side);
    }
    incident_[face] = inner;
  }
  for (unsigned face = 0; face < 4; ++face) {
    Tet& ghost = tets_[face + 1];
    for (unsigned side = 0; side < 3; ++side) {
      ghost.mirrors[side] = edges_.at(ghost.vertices[(side + 2) % 3].value, ghost.vertices[(side + 1) % 3].value);
    }
  }
}

void BowyerWatson::clear() {
  points_.clear();
  incident_.clear();
  tets_.clear();
  free_.clear();
  region_size_ = 0;
  rim_size_ = 0;
  created_.clear();
  ranks_.clear();
}

void BowyerWatson::number_as_input(std::span<const Vec3> points, std::vector<VertexId>& vertex_of) {
  // Number the vertices in the order of the input, skipping duplicates.
  std::vector<VertexId> renamed(points_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VertexId v = vertex_of[i];
    if (ranks_[v.index()] != VertexId(i)) continue;
    renamed[v.index()] = VertexId(count);
    points_[count++] = points[i];
  }
  // Rename them everywhere.
  for (VertexId& v : vertex_of) v = renamed[v.index()];
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    for (VertexId& v : tets_[t].vertices) {
      if (v.is_none()) continue;
      v = renamed[v.index()];
      incident_[v.index()] = TetId(t);
    }
  }
  ranks_.clear();
  ranks_.shrink_to_fit();
}

}  // namespace deliso
