// Pairs of triangles of a mesh that meet beyond what they share, decided exactly on the given coordinates: crossing and
// touching ones (delaunay/triangle_contact.h). Triangles of zero area have no plane; they are counted and left out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangle_contact.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

struct TrianglePair {
  std::uint32_t first = 0;  // indices of the triangles, first < second
  std::uint32_t second = 0;
  TriangleContact contact = TriangleContact::kNone;
  Vec3 position;  // the middle of what their bounding boxes have in common
};

struct SelfIntersections {
  std::int64_t crossing_pairs = 0;
  std::int64_t touching_pairs = 0;
  std::int64_t zero_area_triangles = 0;  // left out
  std::vector<TrianglePair> crossing;    // the first ones in order of (first, second)
  std::vector<TrianglePair> touching;    // the same

  [[nodiscard]] std::int64_t meeting_pairs() const { return crossing_pairs + touching_pairs; }
};

// Finds all pairs and keeps at most `keep` of each kind, the same for any number of threads. Precondition: indices in
// range, finite coordinates; they are scaled to where orient3d is exact (delaunay/predicates.h).
SelfIntersections self_intersections(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep = 10,
                                     int threads = 1);
// The same for the pairs with a marked triangle (a mark that is not 0). Precondition: as many marks as triangles, or
// none, which marks all; coordinates as orient3d requires them. The mesh, if moved in, is freed before the search,
// which needs the most memory.
SelfIntersections self_intersections_of(std::span<const std::uint8_t> marks, TriangleMesh mesh, std::size_t keep = 10,
                                        int threads = 1);
inline SelfIntersections self_intersections(const TriangleMesh& mesh, std::size_t keep = 10) {
  return self_intersections(mesh.points, mesh.triangles, keep);
}

}  // namespace deliso
