#include "surface/restricted/signed_delaunay.h"

#include <algorithm>
#include <cmath>

#include "delaunay/base/check.h"
#include "delaunay/constructions.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// Guards sit this many box diagonals off the plane of coplanar points.
constexpr double kGuardDistance = 16;
// Smaller coordinates count as zero: the exact predicates do not cover them, and a surface point may lie arbitrarily
// near to a side of the box.
constexpr double kSmallestCoordinate = 0x1p-100;

// The margin around the box of all points, as a fraction of its size. The smaller it is, the more often the static
// filter decides an orientation.
constexpr double kToSpare = 1.0 / 64;

Box3 with_margin(const Box3& box, const Vec3& reach) {
  Box3 large = box;
  large.extend(box.low - reach);
  large.extend(box.high + reach);
  return large;
}

// A unit normal of the plane that all the points lie in.
Vec3 plane_normal(std::span<const Vec3> points) {
  const Vec3& a = points.front();
  Vec3 b = a;
  for (const Vec3& p : points) {
    if (squared_distance(a, p) > squared_distance(a, b)) b = p;
  }
  Vec3 best;
  for (const Vec3& p : points) {
    const Vec3 n = cross(b - a, p - a);
    if (squared_norm(n) > squared_norm(best)) best = n;
  }
  if (!(squared_norm(best) > 0)) throw InputError("the isosurface has fewer than three points that are not in line");
  return best / norm(best);
}

// The limit of clamp(point) for a point that runs to infinity along the line.
Vec3 clamped_limit(const Box3& box, const Vec3& origin, const Vec3& direction) {
  Vec3 p = box.clamp(origin);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (direction[axis] > 0) p[axis] = box.high[axis];
    if (direction[axis] < 0) p[axis] = box.low[axis];
  }
  return p;
}

}  // namespace

Vec3 SignedDelaunay::snapped(const Vec3& given) const {
  const auto snap = [](double x) { return std::abs(x) < kSmallestCoordinate ? 0 : x; };
  const Vec3 p = isosurface_.settled(given);
  return {snap(p.x), snap(p.y), snap(p.z)};
}

SignedDelaunay::SignedDelaunay(const Isosurface& isosurface, std::span<const Vec3> given, int threads,
                               std::vector<VertexId>* vertex_of)
    : isosurface_(isosurface), delaunay_(with_margin(isosurface.box(), kToSpare * isosurface.box().size())) {
  std::vector<Vec3> points;
  points.reserve(given.size());
  for (const Vec3& p : given) {
    if (is_finite(p)) points.push_back(snapped(p));
  }
  std::vector<VertexId> vertices;
  if (!delaunay_.build_in_slabs(points, &vertices, threads)) {
    if (points.empty()) throw InputError("the isosurface has no point to start from");
    std::vector<Vec3> guarded(points.begin(), points.end());
    const Vec3 off = kGuardDistance * isosurface.box().diagonal() * plane_normal(points);
    guarded.push_back(points.front() + off);
    guarded.push_back(points.front() - off);
    const double reach = (kGuardDistance + 1) * isosurface.box().diagonal();
    delaunay_ = BowyerWatson(with_margin(isosurface.box(), {reach, reach, reach}));
    DELISO_CHECK(delaunay_.build(guarded, &vertices), "guards must lift coplanar points into space");
    guards_ = 2;
    first_guard_ = static_cast<std::uint32_t>(delaunay_.vertex_count()) - guards_;
  }
  if (vertex_of != nullptr) {
    vertex_of->assign(given.size(), VertexId::none());
    for (std::size_t i = 0, finite = 0; i < given.size(); ++i) {
      if (is_finite(given[i])) (*vertex_of)[i] = vertices[finite++];
    }
  }
  sign_.resize(delaunay_.tet_slots());
  for_each_block(sign_.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (delaunay_.is_live(TetId(i))) sign_[i] = sign_of(TetId(i));
    }
  });
}

bool SignedDelaunay::exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming,
                              ExchangedPoints& exchanged) {
  exchanged = {};
  if (guards_ > 0) return false;
  std::vector<bool> is_renewed(delaunay_.tet_slots(), false);
  const auto note = [&](std::span<const TetId> tets) {
    is_renewed.resize(std::max(is_renewed.size(), delaunay_.tet_slots()), false);
    for (const TetId t : tets) is_renewed[t.index()] = true;
  };
  // Step 1: remove vertices first, because a new point may lie where an old one is removed.
  std::vector<BowyerWatson::Going> goes(delaunay_.vertex_count(), BowyerWatson::Going::kNo);
  for (const VertexId v : leaving) goes[v.index()] = BowyerWatson::Going::kYes;
  for (const VertexId v : leaving) {
    if (goes[v.index()] == BowyerWatson::Going::kNo) continue;  // already removed together with another one
    if (!delaunay_.remove(v, goes)) return false;
    note(delaunay_.destroyed());
    note(delaunay_.created());
  }
  exchanged.renamed = delaunay_.close_gaps();
  // Step 2: insert.
  TetId hint = delaunay_.incident_tet(VertexId(std::size_t{0}));
  for (const Vec3& given : coming) {
    exchanged.vertex_of.push_back(VertexId::none());
    if (!is_finite(given)) continue;
    const auto duplicate = delaunay_.find_conflicts(snapped(given), hint);
    exchanged.vertex_of.back() = duplicate.value_or(VertexId(delaunay_.vertex_count()));
    if (duplicate) continue;
    note(delaunay_.conflict_region());
    delaunay_.fill_cavity();
    note(delaunay_.created());
    hint = delaunay_.created().front();
  }
  // Step 3: signs.
  for (std::size_t i = 0; i < is_renewed.size(); ++i) {
    if (is_renewed[i]) exchanged.renewed.emplace_back(i);
  }
  sign_.resize(delaunay_.tet_slots());
  for (const TetId t : exchanged.renewed) sign_[t.index()] = delaunay_.is_live(t) ? sign_of(t) : Sign::kBelow;
  return true;
}

Vec3 SignedDelaunay::dual_point(TetId t) const {
  const auto& v = delaunay_.vertices(t);
  const Vec3& a = delaunay_.point(v[0]);
  const Vec3& b = delaunay_.point(v[1]);
  const Vec3& c = delaunay_.point(v[2]);
  if (!delaunay_.is_ghost(t)) return circumcenter(a, b, c, delaunay_.point(v[3]));
  return clamped_limit(isosurface_.box(), circumcircle(a, b, c).center, cross(b - a, c - a));
}

bool SignedDelaunay::on_box(const Box3& box, const Vec3& p) {
  return p.x == box.low.x || p.y == box.low.y || p.z == box.low.z || p.x == box.high.x || p.y == box.high.y ||
         p.z == box.high.z;
}

}  // namespace deliso
