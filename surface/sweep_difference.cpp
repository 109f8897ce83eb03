#include "surface/sweep_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace deliso {

namespace {

// A difference of one that lasts for fewer layers than this is taken for one in shape.
constexpr std::int64_t kLasting = 6;
// Levels looked at beyond those of the start and the end.
constexpr std::int64_t kSlack = 1;

// The Euler characteristic of what lies below each layer: V - E + F of the simplices whose vertices all do.
std::vector<std::int64_t> swept_characteristic(const MeshPart& part, std::size_t axis, double step,
                                               std::size_t layers) {
  std::vector<std::int64_t> change(layers, 0);
  const SurfaceMesh& mesh = part.mesh;
  const auto layer = [&](double x) {
    return static_cast<std::size_t>(std::clamp(std::ceil(x / step), 0.0, static_cast<double>(layers - 1)));
  };
  std::vector<bool> seen(mesh.points.size(), false);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (!part.counts(v[0])) continue;
    std::array<double, 3> x{};
    for (unsigned i = 0; i < 3; ++i) x[i] = mesh.points[v[i]][axis];
    for (unsigned i = 0; i < 3; ++i) {
      if (!seen[v[i]]) ++change[layer(x[i])];
      seen[v[i]] = true;
      const TriangleSide across = mesh.neighbours[t][i];
      if (across == kNoSide || across < 4 * t + i) --change[layer(std::max(x[(i + 1) % 3], x[(i + 2) % 3]))];
    }
    ++change[layer(std::max({x[0], x[1], x[2]}))];
  }
  for (std::size_t i = 1; i < change.size(); ++i) change[i] += change[i - 1];
  return change;
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
                                                       const std::array<std::int32_t, 3>& dims) {
  std::array<std::vector<std::int32_t>, 3> jumps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto layers = static_cast<std::size_t>(dims[axis]);
    std::vector<std::int64_t> gap = swept_characteristic(mesh, axis, step[axis], layers);
    const std::vector<std::int64_t> right = swept_characteristic(exact, axis, step[axis], layers);
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] -= right[i];
    jumps[axis] = lasting_jumps(gap);
  }
  return jumps;
}

}  // namespace deliso
