#include "delaunay/bowyer_watson.h"

#include "delaunay/base/check.h"
#include "delaunay/point_location.h"
#include "delaunay/spatial_order.h"

namespace deliso {

BowyerWatson::BowyerWatson(const Box3& box) : box_(box), filter_(box) {}

namespace {

// Positions in `order` of four points that span space, among them the first; empty when all points are coplanar.
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

bool BowyerWatson::build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of) {
  clear();
  for (const Vec3& p : points) DELISO_CHECK(box_.contains(p), "every point lies in the box");
  if (vertex_of != nullptr) vertex_of->clear();
  if (points.empty()) return false;

  // Step 1: the insertion order, and four points that span space to begin with.
  const std::vector<std::uint32_t> order = spatial_order(points);
  const auto simplex = find_simplex(points, order);
  if (!simplex) return false;

  // Step 2: insert, each point from the tetrahedron created last. The ids are those of the input: the perturbation, and
  // with it the result, does not depend on the order. Equal points follow each other by index, so the one inserted is
  // the one with the least index.
  points_.assign(points.begin(), points.end());
  incident_.resize(points.size());
  tets_.reserve(8 * points.size());
  mark_.reserve(8 * points.size());
  std::vector<VertexId> vertices(points.size());
  bool duplicates = false;
  start({VertexId(order[(*simplex)[0]]), VertexId(order[(*simplex)[1]]), VertexId(order[(*simplex)[2]]),
         VertexId(order[(*simplex)[3]])});
  TetId hint(std::size_t{0});
  for (std::size_t i = 0; i < order.size(); ++i) {
    const VertexId v(order[i]);
    vertices[v.index()] = v;
    if (std::find(simplex->begin(), simplex->end(), i) != simplex->end()) continue;
    const Vec3& p = points_[v.index()];
    if (const auto duplicate = find_conflicts_from_located(p, v, locate(p, hint))) {
      vertices[v.index()] = *duplicate;
      duplicates = true;
      continue;
    }
    star_rim(v);
    hint = created_.front();
  }
  created_.clear();
  if (duplicates) drop_duplicates(vertices);
  if (vertex_of != nullptr) *vertex_of = std::move(vertices);
  return true;
}

TetId BowyerWatson::locate(const Vec3& p, TetId hint) const { return visibility_walk(*this, filter_, p, hint); }

bool BowyerWatson::in_conflict(TetId t, const Vec3& p) const { return conflicts(t, p, VertexId(points_.size())); }

bool BowyerWatson::conflicts(TetId t, const Vec3& p, VertexId p_id) const {
  // A ghost's ball is the half-space beyond its hull facet; on the facet's plane, it is the disk in which that plane
  // cuts the ball of the tetrahedron inside.
  if (is_ghost(t)) {
    const auto& v = vertices(t);
    const double side = filter_.orient(point(v[0]), point(v[1]), point(v[2]), p);
    if (side != 0) return side > 0;
    t = neighbour(t, 3);
  }
  const auto& v = vertices(t);
  const double inside = StaticFilter::insphere_sign(point(v[0]), point(v[1]), point(v[2]), point(v[3]), p);
  if (inside != 0) [[likely]] {
    return inside > 0;
  }
  return perturbed_insphere({point(v[0]), point(v[1]), point(v[2]), point(v[3])}, v, p, p_id);
}

std::optional<VertexId> BowyerWatson::find_conflicts(const Vec3& p, TetId start) {
  DELISO_CHECK(box_.contains(p), "the point lies in the box");
  DELISO_CHECK(region_.empty(), "no other cavity is open");
  DELISO_CHECK(start.index() < tets_.size() && is_live(start), "the search starts from a live tetrahedron");
  const VertexId p_id(points_.size());
  pending_ = p;
  // In conflict with the newest vertex p means strictly inside (or beyond a hull facet): then p is no duplicate.
  if (conflicts(start, p, p_id)) {
    grow_region(p, p_id, start);
    return std::nullopt;
  }
  return find_conflicts_from_located(p, p_id, locate(p, start));
}

std::optional<VertexId> BowyerWatson::find_conflicts_from_located(const Vec3& p, VertexId p_id, TetId located) {
  // The tetrahedron that contains p is in conflict with it, unless p is one of its vertices.
  if (!is_ghost(located)) {
    for (const VertexId v : vertices(located)) {
      if (point(v) == p) return v;
    }
  }
  grow_region(p, p_id, located);
  return std::nullopt;
}

void BowyerWatson::grow_region(const Vec3& p, VertexId p_id, TetId first) {
  region_.clear();
  rim_.clear();
  region_.push_back(first);
  mark_[first.index()] = kInside;
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const TetId t = region_[i];
    const auto mirrors = tets_[t.index()].mirrors;
    for (const FacetId mirror : mirrors) {
      const TetId outside = mirror.tet();
      std::uint8_t& mark = mark_[outside.index()];
      if (mark == kInside) continue;
      if (mark == kUnknown) {
        if (conflicts(outside, p, p_id)) {
          mark = kInside;
          region_.push_back(outside);
          continue;
        }
        mark = kOutside;
      }
      rim_.push_back(mirror);
    }
  }
  for (const TetId t : region_) mark_[t.index()] = kUnknown;
  for (const FacetId f : rim_) mark_[f.tet().index()] = kUnknown;
}

VertexId BowyerWatson::fill_cavity() {
  DELISO_CHECK(!region_.empty(), "find_conflicts has found a region");
  const VertexId v(points_.size());
  points_.push_back(pending_);
  incident_.emplace_back();
  star_rim(v);
  return v;
}

void BowyerWatson::abandon_cavity() {
  region_.clear();
  rim_.clear();
}

void BowyerWatson::star_rim(VertexId apex) {
  // Step 1: slots for the star, those of the region first.
  const std::size_t count = rim_.size();
  created_.clear();
  while (created_.size() < count && created_.size() < region_.size()) created_.push_back(region_[created_.size()]);
  for (std::size_t i = count; i < region_.size(); ++i) {
    tets_[region_[i].index()].vertices[0] = VertexId::none();
    free_.push_back(region_[i]);
  }
  while (created_.size() < count) {
    if (free_.empty()) {
      created_.push_back(TetId(tets_.size()));
      tets_.emplace_back();
      mark_.push_back(kUnknown);
    } else {
      created_.push_back(free_.back());
      free_.pop_back();
    }
  }

  // Step 2: one tetrahedron over each facet of the rim; glue it to the facet and, edge by edge, to its siblings.
  edges_.start(count);
  for (std::size_t i = 0; i < count; ++i) {
    const FacetId outside = rim_[i];
    // Seen from the apex the facet turns the other way round. The infinite vertex goes to slot 3.
    auto [x, z, y] = facet_vertices(outside);
    while (x == kInfiniteVertex || y == kInfiniteVertex) {
      const VertexId first = x;
      x = y;
      y = z;
      z = first;
    }
    const TetId t = created_[i];
    Tet& tet = tets_[t.index()];
    tet.vertices = {apex, x, y, z};
    tet.mirrors[0] = outside;
    tets_[outside.tet().index()].mirrors[outside.face()] = FacetId(t, 0);
    const std::array<VertexId, 3> ring = {x, y, z};
    for (unsigned face = 1; face < 4; ++face) {
      const VertexId a = ring[face % 3];
      const VertexId b = ring[(face + 1) % 3];
      const FacetId here(t, face);
      const FacetId twin = edges_.match(a, b, here);
      if (twin.is_none()) continue;
      tet.mirrors[face] = twin;
      tets_[twin.tet().index()].mirrors[twin.face()] = here;
    }
    incident_[x.index()] = t;
    incident_[y.index()] = t;
    if (z != kInfiniteVertex) incident_[z.index()] = t;
  }
  incident_[apex.index()] = created_.front();
  region_.clear();
  rim_.clear();
}

void BowyerWatson::start(const std::array<VertexId, 4>& simplex) {
  // The first tetrahedron, positively oriented, and a ghost on each of its facets.
  std::array<VertexId, 4> v = simplex;
  if (orient3d(point(v[0]), point(v[1]), point(v[2]), point(v[3])) < 0) std::swap(v[2], v[3]);
  tets_.resize(5);
  mark_.assign(5, kUnknown);
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
      const FacetId here(t, side);
      const FacetId twin = edges_.match(ghost.vertices[(side + 1) % 3], ghost.vertices[(side + 2) % 3], here);
      if (twin.is_none()) continue;
      ghost.mirrors[side] = twin;
      tets_[twin.tet().index()].mirrors[twin.face()] = here;
    }
    incident_[v[face].index()] = inner;
  }
}

void BowyerWatson::clear() {
  points_.clear();
  incident_.clear();
  tets_.clear();
  free_.clear();
  mark_.clear();
  region_.clear();
  rim_.clear();
  created_.clear();
}

void BowyerWatson::drop_duplicates(std::vector<VertexId>& vertex_of) {
  // Number the vertices that stay, in the order of the input, and rename them everywhere.
  std::vector<VertexId> renamed(points_.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (vertex_of[i] != VertexId(i)) continue;
    renamed[i] = VertexId(kept);
    points_[kept] = points_[i];
    incident_[kept] = incident_[i];
    ++kept;
  }
  points_.resize(kept);
  incident_.resize(kept);
  for (Tet& tet : tets_) {
    for (VertexId& v : tet.vertices) {
      if (!v.is_none()) v = renamed[v.index()];
    }
  }
  for (VertexId& v : vertex_of) v = renamed[v.index()];
}

}  // namespace deliso
