// The mesh on which stage 2 works: the data of a triangle that an insertion needs fill one cache line.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/huge_pages.h"
#include "delaunay/base/vec3.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// B_sigma: centred at x_sigma on the isosurface, through the triangle's three vertices.
struct SurfaceDelaunayBall {
  Vec3 center;
  double squared_radius = 0;
};

struct RefinementMesh {
  struct Vertex {
    Vec3 point;
    double pole_height = 0;
    float clearance = 0;          // a bound of the distance to other sheets (clearances.h)
    std::uint32_t attempt = 0;    // the last attempt whose rim has this vertex
    std::uint32_t rim_place = 0;  // and the position in that rim of the edge that leaves this vertex
    // Whether it is a corner of a triangle that lies far off the surface (crossing_guard.h).
    bool is_suspect = false;
    bool is_smoothed = false;  // a slab has tried to move it (smoothing.cpp)
  };
  // Side i of a triangle runs from corner i + 1 to corner i + 2. A neighbour is the same edge as a side of the triangle
  // across.
  struct alignas(64) Triangle {
    std::array<std::uint32_t, 3> corners{};
    std::array<TriangleSide, 3> neighbours{};
    SurfaceDelaunayBall ball;
    std::uint32_t state = 0;    // the flags below, and above them the generation of the slot
    std::uint32_t attempt = 0;  // the last attempt that took the triangle into its disk E

    static constexpr std::uint32_t kRefused = 1;   // refused; waits for a change around it
    static constexpr std::uint32_t kNoHit = 2;     // its dual line has no falling hit: it is not refined
    static constexpr std::uint32_t kTooSmall = 4;  // it is not refined only because of r_min
    static constexpr std::uint32_t kCoarse = 8;    // it is to be refined
    static constexpr std::uint32_t kFlags = kRefused | kNoHit | kTooSmall | kCoarse;
    [[nodiscard]] bool is_refused() const { return (state & kRefused) != 0; }
    [[nodiscard]] bool has_hit() const { return (state & kNoHit) == 0; }
    [[nodiscard]] bool is_too_small() const { return (state & kTooSmall) != 0; }
    [[nodiscard]] bool is_coarse() const { return (state & kCoarse) != 0; }
    void set(std::uint32_t flag, bool is_so) { state = is_so ? state | flag : state & ~flag; }
    // Whether the slot has been reused since the mesh was made or joined.
    [[nodiscard]] bool is_renewed() const { return state > kFlags; }
    // Marks the slot as reused.
    void renew() { state = (state | kFlags) + 1; }
  };
  static_assert(sizeof(Triangle) == 64);

  LargeArray<Vertex> vertices;
  LargeArray<Triangle> triangles;

  RefinementMesh() = default;
  explicit RefinementMesh(const SurfaceMesh& mesh, int threads = 1);

  [[nodiscard]] const Vec3& corner(std::uint32_t triangle, unsigned i) const {
    return vertices[triangles[triangle].corners[i % 3]].point;
  }
  [[nodiscard]] std::array<Vec3, 3> corner_points(const std::array<std::uint32_t, 3>& corners) const {
    return {vertices[corners[0]].point, vertices[corners[1]].point, vertices[corners[2]].point};
  }

  // The interval that a triangle spans along an axis.
  struct Extent {
    double low = 0, high = 0;
    [[nodiscard]] bool holds(double x) const { return low <= x && x <= high; }
  };
  [[nodiscard]] Extent extent_of(std::uint32_t triangle, std::size_t axis) const {
    const auto [a, b, c] = corner_points(triangles[triangle].corners);
    return {std::min({a[axis], b[axis], c[axis]}), std::max({a[axis], b[axis], c[axis]})};
  }

  [[nodiscard]] Box3 box_of(std::uint32_t triangle) const {
    Box3 box;
    for (const std::uint32_t v : triangles[triangle].corners) box.extend(vertices[v].point);
    return box;
  }

  // Prefetches the neighbours of a triangle.
  void prefetch_around(std::uint32_t triangle) const {
    for (const TriangleSide side : triangles[triangle].neighbours) {
      if (side != kNoSide) __builtin_prefetch(&triangles[side >> 2]);
    }
  }

  // Clears the attempts and generations of a finished refinement.
  void forget_attempts(int threads = 1);
  // Writes points and triangles to `mesh`, and pole heights and neighbours, if they are to be kept; this mesh is empty
  // afterwards.
  void move_to(SurfaceMesh& mesh, int threads = 1, bool keep_neighbours = true);
};

}  // namespace deliso
