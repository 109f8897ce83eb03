#include "surface/self_intersection.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/base/parallel.h"
#include "surface/box_tree.h"

namespace deliso {

namespace {

Box3 box_of(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& triangle) {
  Box3 box;
  for (const std::uint32_t v : triangle) box.extend(points[v]);
  return box;
}

// Counts a pair, and keeps it when it is among the first ones by number: pairs come in the order of the tree.
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

}  // namespace

SelfIntersections self_intersections(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep,
                                     int threads) {
  std::vector<std::uint32_t> with_area;
  with_area.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (has_area(points[a], points[b], points[c])) with_area.push_back(t);
  }
  // Broad phase: pairs of boxes that touch; narrow phase: exact tests.
  const auto box = [&](std::size_t i) { return box_of(points, triangles[with_area[i]]); };
  const BoxTree tree(with_area.size(), box, threads);
  const std::vector<BoxTree::PairTask> tasks = tree.pair_tasks();
  std::vector<PairCollector> found(tasks.size(), PairCollector(keep));
  run_tasks(tasks.size(), threads, [&](std::size_t task) {
    tree.for_each_touching_pair(tasks[task], [&](std::uint32_t i, std::uint32_t j) {
      const std::uint32_t s = with_area[i], t = with_area[j];
      const TriangleContact contact = triangle_contact(points, triangles[s], triangles[t]);
      if (contact != TriangleContact::kNone) found[task].add({s, t, contact, middle_of_common(box(i), box(j))});
    });
  });
  PairCollector all(keep);
  for (const PairCollector& part : found) all.add(part);
  SelfIntersections result = std::move(all).sorted();
  result.zero_area_triangles = static_cast<std::int64_t>(triangles.size() - with_area.size());
  return result;
}

}  // namespace deliso
