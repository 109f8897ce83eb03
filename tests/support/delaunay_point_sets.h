// Point sets for the Delaunay tests: from harmless to all ties.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/rng.h"
#include "delaunay/base/vec3.h"

namespace deliso::test {

using Points = std::vector<Vec3>;

inline Box3 box_of(const Points& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

// The points without those that equal an earlier one.
inline Points distinct(const Points& points) {
  Points result;
  for (const Vec3& p : points) {
    if (std::find(result.begin(), result.end(), p) == result.end()) result.push_back(p);
  }
  return result;
}

inline void shuffle(Points& points, Rng& rng) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[rng.below(i)]);
}

inline Points random_points(std::size_t count, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({rng.uniform(), rng.uniform(), rng.uniform()});
  return points;
}

inline Points lattice(int side, Rng& rng) {
  Points points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) points.push_back({double(x), double(y), double(z)});
    }
  }
  shuffle(points, rng);
  return points;
}

// Points exactly on the faces of a box, and some inside.
inline Points box_faces(std::size_t count, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p{rng.uniform(), rng.uniform(), rng.uniform()};
    if (i % 4 != 0) p[rng.below(3)] = double(rng.below(2));
    points.push_back(p);
  }
  return points;
}

// Integer points exactly on a sphere (of squared radius 1105 = 5 * 13 * 17) around an integer center.
inline Points cospherical(Rng& rng) {
  Points points;
  for (int x = -33; x <= 33; ++x) {
    for (int y = -33; y <= 33; ++y) {
      for (int z = -33; z <= 33; ++z) {
        if (x * x + y * y + z * z == 1105) points.push_back({x + 7.0, y - 3.0, z + 1.0});
      }
    }
  }
  shuffle(points, rng);
  return points;
}

// Circles of integer points (x^2 + y^2 = 1105) in parallel planes.
inline Points cocircular(Rng& rng) {
  Points points;
  for (int x = -33; x <= 33; ++x) {
    for (int y = -33; y <= 33; ++y) {
      for (int z = 0; z < 4 && x * x + y * y == 1105; ++z) points.push_back({double(x), double(y), double(z)});
    }
  }
  shuffle(points, rng);
  return points;
}

inline Points rounded_sphere(std::size_t count, Rng& rng) {
  Points points;
  while (points.size() < count) {
    const Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double length = norm(p);
    if (length < 1 && length > 0.1) points.push_back(p / length);
  }
  return points;
}

// Random points on a small lattice: many duplicates, everything degenerate.
inline Points duplicates(std::size_t count, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({double(rng.below(4)), double(rng.below(4)), double(rng.below(4))});
  }
  return points;
}

// Random points and then the same again, with a few far outliers, for whose sake a few of each share a cell of the
// curve along which points are inserted (delaunay/spatial_order.h).
inline Points twice_in_shared_cells(std::size_t count, Rng& rng) {
  Points points = random_points(count / 2, rng);
  for (std::size_t i = 0; i < count / 2; ++i) points.push_back(points[i]);
  for (const Vec3& way : random_points(4, rng)) points.push_back(6000 * way - Vec3{3000, 3000, 3000});
  return points;
}

// Clusters of the size 1e-9 around a few far points.
inline Points clusters(std::size_t count, Rng& rng) {
  const Points centers = random_points(6, rng);
  Points points;
  for (const Vec3& offset : random_points(count, rng)) points.push_back(centers[rng.below(6)] + 1e-9 * offset);
  return points;
}

// A line of points and a few off it: long thin everything.
inline Points line_and_few(std::size_t count, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({double(i), 0, 0});
  for (int i = 0; i < 5; ++i) points.push_back({rng.uniform(0, double(count)), rng.uniform(-1, 1), rng.uniform(-1, 1)});
  shuffle(points, rng);
  return points;
}

struct NamedPoints {
  std::string name;
  Points points;
};

// One of each kind, at most about `size` points each.
inline std::vector<NamedPoints> all_kinds(std::size_t size, Rng& rng) {
  const int side = size >= 300 ? 7 : 4;
  std::vector<NamedPoints> kinds = {
      {"random", random_points(size, rng)},     {"lattice", lattice(side, rng)},
      {"box faces", box_faces(size, rng)},      {"cospherical", cospherical(rng)},
      {"cocircular", cocircular(rng)},          {"rounded sphere", rounded_sphere(size, rng)},
      {"duplicates", duplicates(size, rng)},    {"clusters", clusters(size, rng)},
      {"line and few", line_and_few(size, rng)}};
  for (NamedPoints& kind : kinds) {
    if (kind.points.size() > size + 50) kind.points.resize(size);
  }
  return kinds;
}

}  // namespace deliso::test
