#include "surface/intersection/self_intersection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/base/check.h"
#include "delaunay/base/parallel.h"
#include "surface/intersection/box_pairs.h"
#include "surface/intersection/injective_umbrellas.h"
#include "surface/intersection/umbrella_batches.h"
#include "surface/search/kd_order.h"

namespace deliso {

namespace {

Box3 box_of(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& triangle) {
  Box3 box;
  for (const std::uint32_t v : triangle) box.extend(points[v]);
  return box;
}

// Counts pairs, and keeps those that come first by number: pairs are found in another order.
class PairCollector {
 public:
  explicit PairCollector(std::size_t keep) : keep_(keep) {}

  void add(const TrianglePair& pair) {
    const bool is_crossing = pair.contact == TriangleContact::kCrossing;
    ++(is_crossing ? found_.crossing_pairs : found_.touching_pairs);
    insert(is_crossing ? found_.crossing : found_.touching, pair);
  }
  void add(const PairCollector& other) {
    found_.crossing_pairs += other.found_.crossing_pairs;
    found_.touching_pairs += other.found_.touching_pairs;
    for (const TrianglePair& pair : other.found_.crossing) insert(found_.crossing, pair);
    for (const TrianglePair& pair : other.found_.touching) insert(found_.touching, pair);
  }
  SelfIntersections sorted() && {
    std::sort_heap(found_.crossing.begin(), found_.crossing.end(), earlier);
    std::sort_heap(found_.touching.begin(), found_.touching.end(), earlier);
    return std::move(found_);
  }

 private:
  static bool earlier(const TrianglePair& a, const TrianglePair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  void insert(std::vector<TrianglePair>& kept, const TrianglePair& pair) const {
    kept.push_back(pair);
    std::push_heap(kept.begin(), kept.end(), earlier);
    if (kept.size() <= keep_) return;
    std::pop_heap(kept.begin(), kept.end(), earlier);
    kept.pop_back();
  }

  std::size_t keep_;
  SelfIntersections found_;
};

Vec3 middle_of_common(const Box3& a, const Box3& b) {
  Vec3 middle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * std::max(a.low[axis], b.low[axis]) + 0.5 * std::min(a.high[axis], b.high[axis]);
  }
  return middle;
}

// The triangles that have an area, in rows of eight, umbrella by umbrella in the order of repeated halving; and their
// vertices in the order in which they occur there. So neighbours in space are neighbours in memory. If no triangles can
// meet at a vertex (injective_umbrellas.h), its number is a label of its triangles.
class OrderedTriangles {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  OrderedTriangles(std::span<const Vec3> points, std::span<const Corners> triangles, int threads) {
    DELISO_CHECK(points.size() < LabelRow::kVoid, "numbers of vertices leave the top bit free");
    for (const Vec3& p : points) whole_.extend(p);
    std::vector<std::uint8_t> laid_out;
    {
      // Freed before the new arrays are made, because the peak memory of a whole run may be here.
      std::vector<ProjectedTriangle> projected;
      std::vector<std::uint8_t> has_area;
      look_at(points, triangles, projected, has_area);
      const VertexCorners corners(points.size(), triangles, [&](std::size_t t) { return has_area[t] != 0; });
      laid_out = injective_umbrellas(triangles, projected, corners, points.size(), threads);
      place(umbrella_batches(triangles, has_area, corners, points.size()), points, threads);
    }
    renumber(points, triangles, laid_out);
  }

  // The number of slots for triangles; some may be empty.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t places() const { return numbers_.size(); }
  [[nodiscard]] bool is_empty(std::size_t i) const { return numbers_[i] == kNone; }
  // The number of a triangle in the input.
  [[nodiscard]] std::uint32_t number(std::size_t i) const { return numbers_[i]; }
  // In the order of occurrence.
  [[nodiscard]] Corners corners(std::size_t i) const {
    Corners corners = labels_[i / kBoxesPerRow].of(i % kBoxesPerRow);
    for (std::uint32_t& v : corners) v &= ~LabelRow::kVoid;
    return corners;
  }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  [[nodiscard]] const std::vector<LabelRow>& labels() const { return labels_; }
  // A box that holds all points.
  [[nodiscard]] const Box3& whole() const { return whole_; }
  // Empty if there is no triangle in the slot.
  [[nodiscard]] Box3 box(std::size_t i) const { return is_empty(i) ? Box3{} : box_of(points_, corners(i)); }

  [[nodiscard]] TrianglePair pair(std::uint32_t i, std::uint32_t j, TriangleContact contact) const {
    const auto [first, second] = std::minmax(numbers_[i], numbers_[j]);
    return {first, second, contact, middle_of_common(box(i), box(j))};
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  void look_at(std::span<const Vec3> points, std::span<const Corners> triangles,
               std::vector<ProjectedTriangle>& projected, std::vector<std::uint8_t>& has_area) {
    projected.reserve(triangles.size());
    has_area.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) {
      projected.emplace_back(points[a], points[b], points[c]);
      const bool has = projected.back().senses() != 0 || deliso::has_area(points[a], points[b], points[c]);
      has_area.push_back(has ? 1 : 0);
      count_ += has ? 1 : 0;
    }
  }

  // Orders the rows and assigns slots to the triangles. A row that has room for the next row takes it in.
  void place(const std::vector<UmbrellaBatch>& rows, std::span<const Vec3> points, int threads) {
    const CentreLattice lattice(whole_);
    std::vector<LatticePlace> centres;
    centres.reserve(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) centres.push_back(lattice.place(points[rows[r].vertex], r));
    const auto centre_of = [&](std::uint32_t r) { return points[rows[r].vertex]; };
    numbers_.reserve(kBoxesPerRow * rows.size());
    std::size_t left = 0;  // free slots in the last row
    for (const std::uint32_t r : kd_order(std::move(centres), centre_of, threads)) {
      const UmbrellaBatch& row = rows[r];
      if (row.count > left) {
        numbers_.resize(numbers_.size() + left, kNone);
        left = kBoxesPerRow;
      }
      numbers_.insert(numbers_.end(), row.triangles.begin(), row.triangles.begin() + row.count);
      left -= row.count;
    }
    numbers_.resize(numbers_.size() + left, kNone);
  }

  void renumber(std::span<const Vec3> points, std::span<const Corners> triangles,
                std::span<const std::uint8_t> laid_out) {
    std::vector<std::uint32_t> labels(points.size(), kNone);
    points_.reserve(std::min(points.size(), 3 * count_));
    labels_.resize(numbers_.size() / kBoxesPerRow);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (is_empty(i)) continue;
      Corners corners = triangles[numbers_[i]];
      for (std::uint32_t& v : corners) {
        std::uint32_t& label = labels[v];
        if (label == kNone) {
          label = static_cast<std::uint32_t>(points_.size()) | (laid_out[v] != 0 ? 0 : LabelRow::kVoid);
          points_.push_back(points[v]);
        }
        v = label;
      }
      labels_[i / kBoxesPerRow].set(i % kBoxesPerRow, corners);
    }
  }

  std::size_t count_ = 0;
  std::vector<std::uint32_t> numbers_;
  std::vector<LabelRow> labels_;
  std::vector<Vec3> points_;
  Box3 whole_;
};

// Whether floats distinguish most boxes; examines the first triangles of rows.
bool floats_do(const OrderedTriangles& triangles) {
  // As a fraction of the whole; rounding moves a coordinate by at most 2^-25 of it.
  constexpr double kSmallest = 0x1p-19;
  constexpr std::size_t kMostSmall = 128;
  const double smallest = kSmallest * norm(triangles.whole().size());
  std::size_t small = 0;
  for (std::size_t i = 0; i < triangles.places() && small <= kMostSmall; i += kBoxesPerRow) {
    small += norm(triangles.box(i).size()) < smallest ? 1 : 0;
  }
  return small <= kMostSmall;
}

// Broad phase: pairs of boxes that touch, except pairs at a vertex whose triangles cannot meet. Narrow phase: exact
// tests.
template <class Real>
PairCollector find_pairs(std::span<const std::uint8_t> marks, const OrderedTriangles& ordered, std::size_t keep,
                         int threads) {
  const BoxPairs<Real> pairs(ordered.places(), ordered.whole().low, ordered.labels(),
                             [&](std::size_t i) { return ordered.box(i); });
  const auto tasks = pairs.tasks();
  std::vector<PairCollector> found(tasks.size(), PairCollector(keep));
  run_tasks(tasks.size(), threads, [&](std::size_t task) {
    pairs.for_each(tasks[task], [&](std::uint32_t i, std::uint32_t j) {
      if (!marks.empty() && marks[ordered.number(i)] == 0 && marks[ordered.number(j)] == 0) return;
      const TriangleContact contact = triangle_contact(ordered.points(), ordered.corners(i), ordered.corners(j));
      if (contact != TriangleContact::kNone) found[task].add(ordered.pair(i, j, contact));
    });
  });
  PairCollector all(keep);
  for (const PairCollector& part : found) all.add(part);
  return all;
}

SelfIntersections examined(const OrderedTriangles& ordered, std::size_t triangle_count,
                           std::span<const std::uint8_t> marks, std::size_t keep, int threads) {
  PairCollector found = floats_do(ordered) ? find_pairs<float>(marks, ordered, keep, threads)
                                           : find_pairs<double>(marks, ordered, keep, threads);
  SelfIntersections result = std::move(found).sorted();
  result.zero_area_triangles = static_cast<std::int64_t>(triangle_count - ordered.count());
  return result;
}

// The power of two that brings the largest coordinate to where products of coordinates neither overflow nor vanish; 1
// where it is there already. Scaling by it changes no sign.
double scale_to_exact_range(std::span<const Vec3> points) {
  constexpr int kSmallest = -60, kLargest = 199;  // exponents
  double largest = 0;
  for (const Vec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (largest == 0) return 1;
  const int exponent = std::ilogb(largest);
  return std::ldexp(1.0, std::clamp(exponent, kSmallest, kLargest) - exponent);
}

void scale_positions(std::vector<TrianglePair>& pairs, double scale) {
  for (TrianglePair& pair : pairs) pair.position = scale * pair.position;
}

}  // namespace

SelfIntersections self_intersections(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep,
                                     int threads) {
  if (scale_to_exact_range(points) == 1) {
    return examined(OrderedTriangles(points, triangles, threads), triangles.size(), {}, keep, threads);
  }
  // Points of no triangle do not count: scaled by a huge one, all others would vanish.
  std::vector<Vec3> scaled_points(points.size());
  for (const auto& triangle : triangles) {
    for (const std::uint32_t v : triangle) scaled_points[v] = points[v];
  }
  const double scale = scale_to_exact_range(scaled_points);
  for (Vec3& p : scaled_points) p = scale * p;
  SelfIntersections found =
      examined(OrderedTriangles(scaled_points, triangles, threads), triangles.size(), {}, keep, threads);
  scale_positions(found.crossing, 1 / scale);
  scale_positions(found.touching, 1 / scale);
  return found;
}

SelfIntersections self_intersections_of(std::span<const std::uint8_t> marks, TriangleMesh mesh, std::size_t keep,
                                        int threads) {
  const std::size_t triangle_count = mesh.triangles.size();
  const OrderedTriangles ordered(mesh.points, mesh.triangles, threads);
  mesh = {};
  return examined(ordered, triangle_count, marks, keep, threads);
}

}  // namespace deliso
