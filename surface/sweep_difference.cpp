#include "surface/sweep_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace deliso {

namespace {

// A difference of one that lasts for fewer layers than this is taken for one in shape.
constexpr std::int64_t kLasting = 6;
// Levels looked at beyond those of the start and the end.
constexpr std::int64_t kSlack = 1;

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

std::array<std::int32_t, 3> layers_at(const Vec3& p, const Vec3& step, const std::array<std::int32_t, 3>& dims) {
  std::array<std::int32_t, 3> layers{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    layers[axis] = static_cast<std::int32_t>(std::clamp(std::ceil(p[axis] / step[axis]), 0.0, dims[axis] - 1.0));
  }
  return layers;
}

// V - E + F of the simplices whose vertices all lie below.
std::vector<SweptCharacteristics> swept_characteristics(const SurfaceMesh& mesh,
                                                        const std::vector<std::uint32_t>& part_of_vertex,
                                                        std::size_t parts, const Vec3& step,
                                                        const std::array<std::int32_t, 3>& dims) {
  SweptCharacteristics none;
  for (std::size_t axis = 0; axis < 3; ++axis) none[axis].assign(static_cast<std::size_t>(dims[axis]), 0);
  std::vector<SweptCharacteristics> changes(parts, none);
  // A vertex counts when a triangle has it; its layers are found then.
  constexpr std::int32_t kUnseen = -1;
  std::vector<std::array<std::int32_t, 3>> layers(mesh.points.size(), {kUnseen, 0, 0});
  const auto see = [&](std::uint32_t v, SweptCharacteristics& change) {
    if (layers[v][0] != kUnseen) return;
    layers[v] = layers_at(mesh.points[v], step, dims);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ++change[axis][static_cast<std::size_t>(layers[v][axis])];
    }
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (part_of_vertex[v[0]] == kNoPart) continue;
    SweptCharacteristics& change = changes[part_of_vertex[v[0]]];
    std::array<bool, 3> counts_edge{};  // an edge counts from the larger of its two sides
    for (unsigned i = 0; i < 3; ++i) {
      see(v[i], change);
      const TriangleSide across = mesh.neighbours[t][i];
      counts_edge[i] = across == kNoSide || across < 4 * t + i;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::array<std::int32_t, 3> at = {layers[v[0]][axis], layers[v[1]][axis], layers[v[2]][axis]};
      for (unsigned i = 0; i < 3; ++i) {
        if (counts_edge[i]) --change[axis][static_cast<std::size_t>(std::max(at[(i + 1) % 3], at[(i + 2) % 3]))];
      }
      ++change[axis][static_cast<std::size_t>(std::max({at[0], at[1], at[2]}))];
    }
  }
  for (SweptCharacteristics& change : changes) {
    for (std::vector<std::int64_t>& along : change) std::partial_sum(along.begin(), along.end(), along.begin());
  }
  return changes;
}

std::array<std::vector<std::int32_t>, 3> jumps_between(const SweptCharacteristics& mesh,
                                                       const SweptCharacteristics& exact) {
  std::array<std::vector<std::int32_t>, 3> jumps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::int64_t> gap = mesh[axis];
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] -= exact[axis][i];
    jumps[axis] = lasting_jumps(gap);
  }
  return jumps;
}

}  // namespace deliso
