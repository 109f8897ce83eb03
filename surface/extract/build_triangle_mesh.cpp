#include "surface/extract/build_triangle_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "delaunay/base/check.h"
#include "surface/extract/edge_positions.h"

namespace deliso {

namespace {

constexpr std::uint32_t kNoFan = 0xFFFFFFFFu;

// A corner at a vertex with several fans. Corner 3 t + i is that of triangle t at its vertex i.
struct SplitCorner {
  std::uint32_t corner = 0;
  std::uint32_t fan = kNoFan;
};

class MeshBuilder {
 public:
  MeshBuilder(const SignedDelaunay& restricted, PairedTriangles paired)
      : restricted_(restricted),
        delaunay_(restricted_.delaunay()),
        contested_sides_(std::move(paired.contested)),
        is_split_(std::move(paired.is_split)) {
    mesh_.triangles = std::move(paired.triangles);
    mesh_.neighbours = std::move(paired.neighbours);
  }

  BuiltMesh build() {
    name_vertices();
    subdivide_shared_edges();
    group_copies();
    return std::move(built_);
  }

 private:
  void name_vertices();
  [[nodiscard]] std::vector<SplitCorner> number_fans(std::vector<std::uint32_t>& fans_before) const;
  void subdivide_shared_edges();
  void make_room(std::size_t edges);

  [[nodiscard]] TriangleSide find_side(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const;
  Copy subdivide(TriangleSide side);
  std::pair<TriangleSide, TriangleSide> split_triangle(TriangleSide side, std::uint32_t m);
  void link(TriangleSide a, TriangleSide b);
  [[nodiscard]] Vec3 normal_of(std::uint32_t triangle) const;
  void group_copies();

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  BuiltMesh built_;
  SurfaceMesh& mesh_ = built_.mesh;
  std::vector<TriangleSide> contested_sides_;
  std::vector<bool> is_split_;                                  // of each vertex of the triangulation
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts_;  // (triangle split, new part)
};

// Corners joined across paired edges form one vertex; every other class of corners at the same point is a copy of its
// own. Vertices are numbered in order of (vertex of the triangulation, first corner).
void MeshBuilder::name_vertices() {
  // Step 1: count the mesh vertices at each vertex of the triangulation, and number the fans at those with several.
  std::vector<std::uint32_t> first(delaunay_.vertex_count() + 1, 0);  // entry v + 1 counts for v
  const std::vector<SplitCorner> split_corners = number_fans(first);
  const std::size_t count = std::accumulate(first.begin(), first.end(), std::size_t{0});
  mesh_.points.reserve(count);
  built_.vertex_of.reserve(count);
  // Step 2: points and numbers; first[v] becomes the number of the first mesh vertex at v.
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const bool is_split = first[v + 1] > 1;
    first[v + 1] += first[v];
    for (std::uint32_t name = first[v]; name < first[v + 1]; ++name) {
      mesh_.points.push_back(delaunay_.point(VertexId(v)));
      built_.vertex_of.emplace_back(v);
      if (is_split) built_.copies.push_back(name);
    }
  }
  auto next = split_corners.begin();
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      std::uint32_t& v = mesh_.triangles[t][i];
      const bool is_split = next != split_corners.end() && next->corner == 3 * t + i;
      v = is_split ? first[v] + (next++)->fan : first[v];
    }
  }
}

// Counts the fans at each vertex. Where there are several, it numbers them, and returns the number for each corner at
// such a vertex, ascending by corner.
std::vector<SplitCorner> MeshBuilder::number_fans(std::vector<std::uint32_t>& fans_before) const {
  std::vector<SplitCorner> split_corners;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh_.triangles[t][i];
      if (is_split_[v]) {
        split_corners.push_back({3 * t + i});
      } else {
        fans_before[v + 1] = 1;
      }
    }
  }
  const auto fan_of = [&](std::uint32_t c) -> std::uint32_t& {
    return std::lower_bound(split_corners.begin(), split_corners.end(), c,
                            [](const SplitCorner& at, std::uint32_t wanted) { return at.corner < wanted; })
        ->fan;
  };
  for (const SplitCorner& at : split_corners) {
    if (at.fan != kNoFan) continue;
    const std::uint32_t fan = fans_before[mesh_.triangles[at.corner / 3][at.corner % 3] + 1]++;
    for_each_corner_of_fan(
        at.corner, [&](TriangleSide side) { return mesh_.neighbours[side >> 2][side & 3u]; },
        [&](std::uint32_t c) { return std::exchange(fan_of(c), fan) == kNoFan; });
  }
  return split_corners;
}

// A contested edge may be shared by two pairs of facets even after its ends are split. Such an edge is subdivided in
// each pair.
void MeshBuilder::subdivide_shared_edges() {
  using Use = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // two vertices, a triangle
  std::vector<Use> uses;
  for (const TriangleSide side : contested_sides_) {
    const std::uint32_t t = side >> 2;
    const unsigned i = side & 3u;
    const TriangleSide across = mesh_.neighbours[t][i];
    if (across != kNoSide && across < side) continue;  // one use for each pair
    const std::uint32_t from = mesh_.triangles[t][(i + 1) % 3];
    const std::uint32_t to = mesh_.triangles[t][(i + 2) % 3];
    uses.emplace_back(std::min(from, to), std::max(from, to), t);
  }
  std::sort(uses.begin(), uses.end());
  make_room(uses.size());
  for (std::size_t first = 0; first < uses.size();) {
    const auto [from, to, ignored] = uses[first];
    std::size_t last = first;
    while (last < uses.size() && std::get<0>(uses[last]) == from && std::get<1>(uses[last]) == to) ++last;
    if (last - first > 1) built_.groups.emplace_back();
    for (std::size_t i = first; last - first > 1 && i < last; ++i) {
      const TriangleSide side = find_side(std::get<2>(uses[i]), from, to);
      DELISO_CHECK(side != kNoSide, "a shared edge must still be there when its turn comes");
      built_.groups.back().push_back(subdivide(side));
    }
    first = last;
  }
}

// Reserves memory for the vertices and triangles of a few subdivided edges: arrays that grow by themselves would
// double.
void MeshBuilder::make_room(std::size_t edges) {
  mesh_.points.reserve(mesh_.points.size() + edges);
  built_.vertex_of.reserve(built_.vertex_of.size() + edges);
  mesh_.triangles.reserve(mesh_.triangles.size() + 2 * edges);
  mesh_.neighbours.reserve(mesh_.neighbours.size() + 2 * edges);
}

// The side between two vertices, in a triangle or in the parts into which it was split.
TriangleSide MeshBuilder::find_side(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
  for (unsigned i = 0; i < 3; ++i) {
    const std::uint32_t from = mesh_.triangles[triangle][(i + 1) % 3];
    const std::uint32_t to = mesh_.triangles[triangle][(i + 2) % 3];
    if ((from == a && to == b) || (from == b && to == a)) return 4 * triangle + i;
  }
  for (const auto& [whole, part] : parts_) {
    if (whole != triangle) continue;
    if (const TriangleSide side = find_side(part, a, b); side != kNoSide) return side;
  }
  return kNoSide;
}

Copy MeshBuilder::subdivide(TriangleSide side) {
  const std::uint32_t t = side >> 2;
  const std::uint32_t a = mesh_.triangles[t][((side & 3u) + 1) % 3];
  const std::uint32_t b = mesh_.triangles[t][((side & 3u) + 2) % 3];
  const TriangleSide across = mesh_.neighbours[t][side & 3u];
  const Vec3 normal = normal_of(t) + (across == kNoSide ? Vec3{} : normal_of(across >> 2));
  const SubdividedEdge edge{mesh_.points[a], mesh_.points[b], normal};
  const auto m = static_cast<std::uint32_t>(mesh_.points.size());
  mesh_.points.push_back(positions_on(edge, restricted_.isosurface(), 1).front());
  built_.vertex_of.push_back(built_.vertex_of[a]);

  const auto [to_middle, from_middle] = split_triangle(side, m);
  if (across != kNoSide) {
    const auto [back_to_middle, back_from_middle] = split_triangle(across, m);
    link(to_middle, back_from_middle);
    link(from_middle, back_to_middle);
  }
  return {m, {}, true, edge};
}

// Splits the triangle (c, a, b) at m on its side ab into (c, a, m), which takes its slot, and (c, m, b), which is
// appended. Returns the sides am and mb, whose neighbours are not set yet.
std::pair<TriangleSide, TriangleSide> MeshBuilder::split_triangle(TriangleSide side, std::uint32_t m) {
  const std::uint32_t t = side >> 2;
  const unsigned i = side & 3u;
  const auto corners = mesh_.triangles[t];
  const auto sides = mesh_.neighbours[t];
  const std::uint32_t c = corners[i];
  const std::uint32_t a = corners[(i + 1) % 3];
  const std::uint32_t b = corners[(i + 2) % 3];
  const TriangleSide beyond_a = sides[(i + 1) % 3];
  const TriangleSide beyond_b = sides[(i + 2) % 3];
  const auto part = static_cast<std::uint32_t>(mesh_.triangles.size());
  parts_.emplace_back(t, part);

  mesh_.triangles[t] = {c, a, m};
  mesh_.neighbours[t] = {kNoSide, kNoSide, kNoSide};
  mesh_.triangles.push_back({c, m, b});
  mesh_.neighbours.push_back({kNoSide, kNoSide, kNoSide});
  link(4 * t + 1, 4 * part + 2);
  link(4 * t + 2, beyond_b);
  link(4 * part + 1, beyond_a);
  return {4 * t, 4 * part};
}

void MeshBuilder::link(TriangleSide a, TriangleSide b) {
  if (a != kNoSide) mesh_.neighbours[a >> 2][a & 3u] = b;
  if (b != kNoSide) mesh_.neighbours[b >> 2][b & 3u] = a;
}

Vec3 MeshBuilder::normal_of(std::uint32_t triangle) const {
  const auto& v = mesh_.triangles[triangle];
  const Vec3& a = mesh_.points[v[0]];
  const Vec3 n = cross(mesh_.points[v[1]] - a, mesh_.points[v[2]] - a);
  return norm(n) > 0 ? n / norm(n) : Vec3{};
}

void MeshBuilder::group_copies() {
  const std::size_t subdivided = built_.groups.size();
  for (const std::uint32_t copy : built_.copies) {
    const bool continues = built_.groups.size() > subdivided &&
                           built_.vertex_of[built_.groups.back().back().vertex] == built_.vertex_of[copy];
    if (!continues) built_.groups.emplace_back();
    built_.groups.back().push_back({copy, {}, false, {}});
  }
}

}  // namespace

BuiltMesh build_triangle_mesh(const SignedDelaunay& restricted, PairedTriangles paired) {
  return MeshBuilder(restricted, std::move(paired)).build();
}

BuiltMesh build_triangle_mesh(const FacetPairing& pairing) {
  return build_triangle_mesh(pairing.restricted(), pairing.triangles());
}

BuiltMesh build_triangle_mesh(const SignedDelaunay& restricted, int threads) {
  return build_triangle_mesh(FacetPairing(restricted, threads));
}

}  // namespace deliso
