#include "surface/recover/component_seeds.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// Axes and space diagonals, slightly turned so that ties on a grid are rare.
constexpr std::array<Vec3, 7> kDirections = {
    Vec3{1, 1.3e-3, 2.1e-4},  Vec3{-2.3e-4, 1, 1.1e-3}, Vec3{1.7e-3, -3.1e-4, 1}, Vec3{1, 1.001, 1.0003},
    Vec3{1, 1.0007, -1.0001}, Vec3{1, -1.0003, 1.0009}, Vec3{-1, 1.0011, 1.0005}};

// The farthest point of a component in each direction and its opposite.
struct Extremes {
  std::array<double, 14> reach;
  std::array<Vec3, 14> point;
  Extremes() { reach.fill(-std::numeric_limits<double>::infinity()); }

  void extend(const Vec3& p) {
    for (std::size_t i = 0; i < kDirections.size(); ++i) {
      const double along = dot(kDirections[i], p);
      offer(2 * i, along, p);
      offer(2 * i + 1, -along, p);
    }
  }
  // Takes in the extremes of later points; of equals the earlier point stays.
  void extend(const Extremes& later) {
    for (std::size_t i = 0; i < reach.size(); ++i) offer(i, later.reach[i], later.point[i]);
  }

 private:
  void offer(std::size_t i, double along, const Vec3& p) {
    if (!(along > reach[i])) return;
    reach[i] = along;
    point[i] = p;
  }
};

// The seeds found in a share of the crossings: the crossings of small components, and the extremes of each large one.
struct FoundSeeds {
  std::vector<Vec3> of_small;
  std::vector<Extremes> of_large;
};

constexpr std::uint32_t kIsSmall = 0xFFFFFFFFu;

// For each component: its number among the large components, or kIsSmall.
std::vector<std::uint32_t> numbers_of_large(const IsosurfaceTopology& topology, std::uint32_t& count) {
  std::vector<std::uint32_t> crossings(topology.components.size(), 0);
  for (const EdgeCrossing& c : topology.crossings) ++crossings[c.component];
  count = 0;
  for (std::uint32_t& number : crossings) number = number > kSmallComponent ? count++ : kIsSmall;
  return crossings;
}

}  // namespace

std::vector<Vec3> component_seeds(const ExactSurface& surface) {
  const IsosurfaceTopology& topology = surface.topology;
  std::uint32_t large_count = 0;
  const std::vector<std::uint32_t> large = numbers_of_large(topology, large_count);
  const Shares shares(topology.crossings.size(), surface.threads);
  std::vector<FoundSeeds> found(shares.count());
  shares.for_each(surface.threads, [&](std::size_t share, std::size_t first, std::size_t last) {
    FoundSeeds& mine = found[share];
    mine.of_large.resize(large_count);
    for (std::size_t i = first; i < last; ++i) {
      const EdgeCrossing& c = topology.crossings[i];
      const Vec3 p = surface.position(c);
      if (large[c.component] == kIsSmall) {
        mine.of_small.push_back(p);
      } else {
        mine.of_large[large[c.component]].extend(p);
      }
    }
  });
  std::vector<Vec3> seeds;
  for (const FoundSeeds& part : found) seeds.insert(seeds.end(), part.of_small.begin(), part.of_small.end());
  for (std::size_t i = 0; i < large_count; ++i) {
    Extremes extremes;
    for (const FoundSeeds& part : found) extremes.extend(part.of_large[i]);
    seeds.insert(seeds.end(), extremes.point.begin(), extremes.point.end());
  }
  return seeds;
}

std::vector<Vec3> random_ray_points(const Isosurface& isosurface, std::int32_t count, Rng& rng,
                                    SearchCounters& counters, Controls* controls) {
  constexpr std::size_t kFewestPoints = 1000;  // inserted whatever `controls` say
  std::vector<Vec3> points;
  std::vector<Hit> hits;
  const Vec3 size = isosurface.box().size();
  const auto random_point = [&] { return scaled(size, {rng.uniform(), rng.uniform(), rng.uniform()}); };
  for (int misses = 0; static_cast<std::int32_t>(points.size()) < count && misses < 1000;) {
    const std::size_t left = static_cast<std::size_t>(count) - points.size();
    if (controls != nullptr && points.size() >= kFewestPoints && controls->must_stop("initial", points.size(), left))
      break;
    // A line through two random points, cut where it leaves the box.
    const Vec3 a = random_point();
    const Line line{a, random_point() - a};
    double begin = -std::numeric_limits<double>::infinity();
    double end = -begin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (line.direction[axis] == 0) continue;
      const double t0 = -line.origin[axis] / line.direction[axis];
      const double t1 = (size[axis] - line.origin[axis]) / line.direction[axis];
      begin = std::max(begin, std::min(t0, t1));
      end = std::min(end, std::max(t0, t1));
    }
    if (!(begin < end)) continue;
    isosurface.all_hits(line, begin, end, hits, counters);
    if (hits.empty()) {
      ++misses;
      continue;
    }
    misses = 0;
    points.push_back(isosurface.box().clamp(line.at(hits[rng.below(hits.size())].t)));
  }
  return points;
}

}  // namespace deliso
