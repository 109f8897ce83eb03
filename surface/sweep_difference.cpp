#include "surface/sweep_difference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <numeric>

#include "surface/blocks.h"

namespace deliso {

namespace {

// A difference of one that lasts for fewer layers than this is taken for one in shape.
constexpr std::int64_t kLasting = 6;
// Levels looked at beyond those of the start and the end.
constexpr std::int64_t kSlack = 1;

// The layers of samples along each axis: layer 0 of y is offset[1].
struct Layers {
  std::array<std::size_t, 4> offset{};
  Vec3 step;

  Layers(const std::array<std::int32_t, 3>& dims, const Vec3& voxel) : step(voxel) {
    for (std::size_t axis = 0; axis < 3; ++axis) offset[axis + 1] = offset[axis] + static_cast<std::size_t>(dims[axis]);
  }
  // The first layer not below x, or the last one.
  [[nodiscard]] std::size_t at(std::size_t axis, double x) const {
    const auto last = static_cast<double>(offset[axis + 1] - offset[axis] - 1);
    return offset[axis] + static_cast<std::size_t>(std::clamp(std::ceil(x / step[axis]), 0.0, last));
  }
};

// What one thread has counted, and the vertices that all of them have seen.
using Changes = std::vector<std::int64_t>;
using Seen = std::vector<std::uint8_t>;

// Adds edges and triangles of some triangles to the layers where they lie below for the first time; marks the vertices.
void add_triangles(const MeshPart& part, const Layers& layers, std::size_t first, std::size_t last, Seen& seen,
                   Changes& change) {
  const SurfaceMesh& mesh = part.mesh;
  for (std::size_t t = first; t < last; ++t) {
    const auto& v = mesh.triangles[t];
    if (!part.counts(v[0])) continue;
    std::array<bool, 3> counts_edge{};  // each edge from the larger of its two sides
    for (unsigned i = 0; i < 3; ++i) {
      std::atomic_ref<std::uint8_t>(seen[v[i]]).store(1, std::memory_order_relaxed);
      const TriangleSide across = mesh.neighbours[t][i];
      counts_edge[i] = across == kNoSide || across < 4 * t + i;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::size_t, 3> at{};
      for (unsigned i = 0; i < 3; ++i) at[i] = layers.at(axis, mesh.points[v[i]][axis]);
      for (unsigned i = 0; i < 3; ++i) {
        if (counts_edge[i]) --change[std::max(at[(i + 1) % 3], at[(i + 2) % 3])];
      }
      ++change[std::max({at[0], at[1], at[2]})];
    }
  }
}

// The Euler characteristic of what lies below each layer: V - E + F of the simplices whose vertices all do.
Changes swept_characteristic(const MeshPart& part, const Layers& layers, int threads) {
  const SurfaceMesh& mesh = part.mesh;
  Seen seen(mesh.points.size(), 0);
  Changes sum(layers.offset[3], 0);
  std::mutex mutex;
  const auto add = [&](const Changes& change) {
    const std::scoped_lock lock(mutex);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += change[i];
  };
  Shares(mesh.triangles.size(), threads).for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    Changes change(sum.size(), 0);
    add_triangles(part, layers, first, last, seen, change);
    add(change);
  });
  Shares(mesh.points.size(), threads).for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    Changes change(sum.size(), 0);
    for (std::size_t v = first; v < last; ++v) {
      for (std::size_t axis = 0; seen[v] != 0 && axis < 3; ++axis) ++change[layers.at(axis, mesh.points[v][axis])];
    }
    add(change);
  });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::partial_sum(sum.begin() + static_cast<std::ptrdiff_t>(layers.offset[axis]),
                     sum.begin() + static_cast<std::ptrdiff_t>(layers.offset[axis + 1]),
                     sum.begin() + static_cast<std::ptrdiff_t>(layers.offset[axis]));
  }
  return sum;
}

// Where the piecewise constant function from 0 to the last value that fits `gap` best jumps: dynamic programming over
// (place, level) with the sum of the deviations plus kLasting for each jump by one as the cost.
std::vector<std::int32_t> lasting_jumps(const std::vector<std::int64_t>& gap) {
  const std::int64_t low = std::min<std::int64_t>(0, gap.back()) - kSlack;
  const auto levels = static_cast<std::size_t>(std::abs(gap.back()) + 2 * kSlack + 1);
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max() / 4;
  std::vector<std::int64_t> cost(levels, kNever);
  cost[static_cast<std::size_t>(-low)] = 0;
  std::vector<std::vector<std::size_t>> from(gap.size(), std::vector<std::size_t>(levels));
  for (std::size_t i = 0; i < gap.size(); ++i) {
    std::vector<std::int64_t> next(levels, kNever);
    for (std::size_t to = 0; to < levels; ++to) {
      for (std::size_t level = 0; level < levels; ++level) {
        const auto jump = static_cast<std::int64_t>(level > to ? level - to : to - level);
        if (cost[level] + kLasting * jump >= next[to]) continue;
        next[to] = cost[level] + kLasting * jump;
        from[i][to] = level;
      }
      next[to] += std::abs(gap[i] - (low + static_cast<std::int64_t>(to)));
    }
    cost = std::move(next);
  }
  std::vector<std::int32_t> jumps;
  auto level = static_cast<std::size_t>(gap.back() - low);
  for (std::size_t i = gap.size(); i-- > 0;) {
    if (from[i][level] != level) jumps.push_back(static_cast<std::int32_t>(i));
    level = from[i][level];
  }
  std::reverse(jumps.begin(), jumps.end());
  return jumps;
}

}  // namespace

std::array<std::vector<std::int32_t>, 3> jumps_between(const MeshPart& mesh, const MeshPart& exact, const Vec3& step,
                                                       const std::array<std::int32_t, 3>& dims, int threads) {
  const Layers layers(dims, step);
  const Changes ours = swept_characteristic(mesh, layers, threads);
  const Changes right = swept_characteristic(exact, layers, threads);
  std::array<std::vector<std::int32_t>, 3> jumps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::int64_t> gap;
    for (std::size_t i = layers.offset[axis]; i < layers.offset[axis + 1]; ++i) gap.push_back(ours[i] - right[i]);
    jumps[axis] = lasting_jumps(gap);
  }
  return jumps;
}

}  // namespace deliso
