// Refinement: edges that lie across a fold of the isosurface are flipped to run along it. Ours; the paper's mesh is
// that of its balls alone, and at a crease an edge across it stays as far off as it is long.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "surface/refine/refine_loop.h"

namespace deliso {

namespace {

// Edges are looked at where the two triangles turn by more than about 18 degrees.
constexpr double kSharp = 0.95;  // cosine
// A flipped edge is at most this much as far off the isosurface.
constexpr double kNearer = 0.8;
// Edges this near are left alone, in parts of h_min.
constexpr double kNearEnough = 0.2;
// The cosine of 25 degrees: no smaller angle is made, but where one was.
constexpr double kCosLeastAngle = 0.9063;
constexpr int kFlipRounds = 3;

// That of the smallest angle.
double largest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto at = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 u = q - p, v = r - p;
    return dot(u, v) / std::sqrt(squared_norm(u) * squared_norm(v));
  };
  return std::max({at(a, b, c), at(b, c, a), at(c, a, b)});
}

}  // namespace

// An edge from a to b, of two triangles cab and dba that may give way to cad and dbc.
struct RefineLoop::FlippedEdge {
  std::uint32_t triangle, beyond;
  unsigned side, side_beyond;
  std::uint32_t a, b, c, d;
};

std::optional<RefineLoop::FlippedEdge> RefineLoop::flipped_edge(std::uint32_t triangle, unsigned side) const {
  const RefinementMesh::Triangle& t = mesh_.triangles[triangle];
  const TriangleSide across = t.neighbours[side];
  if (across == kNoSide || (across >> 2) < part_.frozen) return std::nullopt;

  const RefinementMesh::Triangle& u = mesh_.triangles[across >> 2];
  return FlippedEdge{.triangle = triangle,
                     .beyond = across >> 2,
                     .side = side,
                     .side_beyond = across & 3u,
                     .a = t.corners[(side + 1) % 3],
                     .b = t.corners[(side + 2) % 3],
                     .c = t.corners[side],
                     .d = u.corners[across & 3u]};
}

// Whether two vertices have an edge already: of them, the one that is a corner of a triangle.
bool RefineLoop::is_edge(std::uint32_t triangle, unsigned corner, std::uint32_t other) const {
  bool found = false;
  for_each_corner_of_fan(
      3 * triangle + corner, [&](TriangleSide side) { return mesh_.triangles[side >> 2].neighbours[side & 3u]; },
      [&](std::uint32_t at) {
        const auto& corners = mesh_.triangles[at / 3].corners;
        found = found || std::find(corners.begin(), corners.end(), other) != corners.end();
        return !found && at != 3 * triangle + corner;
      });
  return found;
}

// The distance of an edge's middle from the isosurface, along a line towards lower values.
double RefineLoop::height_at_middle(const Vec3& a, const Vec3& b, const Vec3& direction) {
  const Line line{0.5 * (a + b), direction};
  const auto hit = isosurface_.nearest_falling_hit(line, distance(a, b), stats_.search);
  return hit ? std::abs(*hit) : std::numeric_limits<double>::infinity();
}

// Whether the flipped edge is nearer to the isosurface, and nothing gets worse.
bool RefineLoop::improves(const FlippedEdge& edge) {
  const auto point = [&](std::uint32_t v) -> const Vec3& { return mesh_.vertices[v].point; };
  const Vec3 &a = point(edge.a), &b = point(edge.b), &c = point(edge.c), &d = point(edge.d);
  const Vec3 n = cross(a - c, b - c), m = cross(b - d, a - d);
  if (!(dot(n, m) < kSharp * std::sqrt(squared_norm(n) * squared_norm(m)))) return false;
  const Vec3 sum = n / std::max(norm(n), 1e-300) + m / std::max(norm(m), 1e-300);
  if (!(norm(sum) > 0)) return false;
  const Vec3 down = sum / norm(sum);
  if (!(dot(cross(a - c, d - c), down) > 0 && dot(cross(b - d, c - d), down) > 0)) return false;
  const double before = std::max(largest_cosine(a, b, c), largest_cosine(a, b, d));
  const double after = std::max(largest_cosine(c, a, d), largest_cosine(d, b, c));
  if (!(after <= std::max(before, kCosLeastAngle))) return false;
  if (is_edge(edge.triangle, edge.side, edge.d)) return false;
  const double height = height_at_middle(a, b, down);
  if (height < kNearEnough * options_.h_min) return false;
  return height_at_middle(c, d, down) < kNearer * std::min(height, distance(a, b));
}

// Replaces the two triangles, in their slots.
void RefineLoop::flip(const FlippedEdge& edge) {
  const std::uint32_t t = edge.triangle, u = edge.beyond;
  start_->keep(t, mesh_);
  start_->keep(u, mesh_);
  guard_->forget(t);
  guard_->forget(u);
  const auto outer_of_t = mesh_.triangles[t].neighbours, outer_of_u = mesh_.triangles[u].neighbours;
  const TriangleSide bc = outer_of_t[(edge.side + 1) % 3], ca = outer_of_t[(edge.side + 2) % 3];
  const TriangleSide ad = outer_of_u[(edge.side_beyond + 1) % 3], db = outer_of_u[(edge.side_beyond + 2) % 3];
  mesh_.triangles[t].corners = {edge.c, edge.a, edge.d};
  mesh_.triangles[t].neighbours = {ad, 4 * u + 1, ca};
  mesh_.triangles[u].corners = {edge.d, edge.b, edge.c};
  mesh_.triangles[u].neighbours = {bc, 4 * t + 1, db};
  for (const std::uint32_t i : {t, u}) {
    for (const unsigned side : {0u, 2u}) {
      const TriangleSide outer = mesh_.triangles[i].neighbours[side];
      if (outer == kNoSide) continue;
      start_->keep(outer >> 2, mesh_);
      mesh_.triangles[outer >> 2].neighbours[outer & 3u] = 4 * i + side;
    }
  }
  std::array<Shape, 2> shapes;
  std::array<NewTriangle, 2> now;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::uint32_t triangle = i == 0 ? t : u;
    shapes[i] = {mesh_.corner_points(mesh_.triangles[triangle].corners), mean_pole_height(triangle)};
  }
  measure(shapes, now);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::uint32_t triangle = i == 0 ? t : u;
    mesh_.triangles[triangle].renew();
    learn(triangle, now[i]);
    guard_->learn(triangle, now[i].squared_longest);
    if (mesh_.triangles[triangle].is_coarse() && is_wanted(triangle)) queue(triangle, now[i]);
  }
}

// Looks at all edges, then again at those of triangles that were flipped. Between slabs and in the whole mesh after
// them only edges of new triangles are looked at: the slabs have done the others.
bool RefineLoop::flip_edges(Controls& controls, int threads) {
  if (options_.h_min <= 0 || controls.poll()) return false;
  const std::int64_t flips_before = stats_.flips;
  std::vector<std::uint32_t> looked_at, flipped;
  for (std::uint32_t t = part_.frozen; t < mesh_.triangles.size(); ++t) {
    if (mesh_.triangles[t].is_renewed()) looked_at.push_back(t);
  }
  if (!looked_at.empty() && !guard_) guard_.emplace(mesh_, threads);
  for (int round = 0; round < kFlipRounds && !looked_at.empty(); ++round) {
    for (const std::uint32_t t : looked_at) {
      for (unsigned side = 0; side < 3; ++side) {
        const auto edge = flipped_edge(t, side);
        if (!edge || !improves(*edge)) continue;
        if (guard_->crosses_flipped({edge->c, edge->a, edge->d}, {edge->d, edge->b, edge->c}, t, edge->beyond))
          continue;
        flip(*edge);
        flipped.insert(flipped.end(), {t, edge->beyond});
        break;
      }
    }
    stats_.flips += std::ssize(flipped) / 2;
    looked_at = std::exchange(flipped, {});
  }
  if (options_.observer != nullptr && stats_.flips > flips_before) options_.observer->improved(mesh_, "folds");
  return queue_.size() > 0;
}

}  // namespace deliso
