#include "delaunay/bowyer_watson.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/spatial_order.h"

namespace deliso {

namespace {

// So many input points are fetched together: they lie anywhere in memory, so their cache misses overlap.
constexpr std::size_t kFetched = 256;
// With so many points or more, parts repay their start. One point in kBeforeParts is inserted before parts begin: then
// only the last one or two rounds are left. The rooms of the two halves hold slightly more vertices than there are
// points.
constexpr std::size_t kFewestForParts = 16384;
constexpr std::size_t kBeforeParts = 8;
constexpr std::size_t kMoreForParts = 4;

// Positions in `order` of four points that are not coplanar, the first point among them; nothing when all are coplanar.
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

bool BowyerWatson::build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of,
                         std::optional<int> threads_of_parts) {
  clear();
  if (vertex_of != nullptr) vertex_of->clear();
  for (const Vec3& p : points) DELISO_CHECK(box_.contains(p), "every point lies in the box");
  if (points.empty()) return false;

  // Step 1: the insertion order, beginning with four points that are not coplanar.
  std::vector<std::uint32_t> order = spatial_order(points);
  const auto simplex = find_simplex(points, order);
  if (!simplex) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>((*simplex)[i]);
    std::rotate(order.begin() + static_cast<std::ptrdiff_t>(i), from, from + 1);
  }

  // Step 2: insert. Vertices are numbered in insertion order, for the caches; the perturbation uses the order of the
  // input.
  std::vector<VertexId> in_order(order.size());
  insert_all({points, order, in_order}, threads_of_parts);
  std::vector<VertexId> vertices(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) vertices[order[i]] = in_order[i];
  // Step 3: number the vertices in the order of the input.
  number_as_input(points, vertices);
  if (vertex_of != nullptr) *vertex_of = std::move(vertices);
  return true;
}

void BowyerWatson::insert_all(const Insertions& all, std::optional<int> threads_of_parts) {
  const std::size_t count = all.order.size(), room = count + kMoreForParts;
  points_.reserve(room);
  incident_.reserve(room);
  ranks_.reserve(room);
  // A point has six or seven tetrahedra in space, eight on a surface; unused pages cost nothing.
  tets_.reserve(10 * count);
  for (std::size_t i = 0; i < 4; ++i) all.vertices[i] = add_vertex(all.order[i], all.points[all.order[i]]);
  make_first_tet();
  const std::size_t by_parts = threads_of_parts && count >= kFewestForParts ? count - count / kBeforeParts : 0;
  insert_in_order(all.part(4, count - by_parts));
  if (by_parts > 0) insert_in_slabs(all.part(count - by_parts, count), *threads_of_parts);
  created_.clear();
}

VertexId BowyerWatson::add_vertex(std::uint32_t input, const Vec3& p) {
  const VertexId v(points_.size());
  points_.push_back(p);
  incident_.emplace_back();
  ranks_.emplace_back(std::size_t{input});
  return v;
}

void BowyerWatson::insert_in_order(const Insertions& some) {
  TetId hint = incident_tet(VertexId(std::size_t{0}));
  std::array<Vec3, kFetched> fetched;
  for (std::size_t begin = 0; begin < some.order.size(); begin += kFetched) {
    const Insertions now = some.part(begin, std::min(begin + kFetched, some.order.size()));
    for (std::size_t i = 0; i < now.order.size(); ++i) fetched[i] = some.points[now.order[i]];
    for (std::size_t i = 0; i < now.order.size(); ++i) {
      if (!now.vertices[i].is_none()) continue;
      // Equal points follow each other by index in the order, so the one with the lowest index becomes the vertex.
      const Vec3& p = fetched[i];
      const auto duplicate = find_conflicts_from_located(p, VertexId(now.order[i]), locate(p, hint));
      now.vertices[i] = duplicate ? *duplicate : add_vertex(now.order[i], p);
      if (duplicate) continue;
      star_rim(now.vertices[i]);
      hint = created_.front();
    }
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
  points_.resize(count);  // parts leave unused numbers
  // Rename the vertices in all arrays.
  for (VertexId& v : vertex_of) v = renamed[v.index()];
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    if (!is_live(TetId(t))) continue;
    for (VertexId& v : tets_[t].vertices) {
      if (v == kInfiniteVertex) continue;
      incident_[v.index()] = TetId(t);  // by its old number: neighbours in that numbering are neighbours in space
      v = renamed[v.index()];
    }
  }
  SharedArray<TetId> incident(count);
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (!renamed[v].is_none()) incident[renamed[v].index()] = incident_[v];
  }
  incident_.swap(incident);
  ranks_ = {};
}

}  // namespace deliso
