#include "surface/repair/diagnosis/euler_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace deliso {

namespace {

// A difference of 1 over fewer layers than this is taken for a difference in shape.
constexpr std::int64_t kLasting = 6;
// How far levels may exceed those of the start and the end.
constexpr std::int64_t kSlack = 1;

// The cheapest way to a level at a layer, over any level at the layer before.
struct Step {
  std::int64_t cost = 0;
  std::uint32_t from = 0;
};

// Of each level: the least cost of coming there, kLasting for each jump by one included; of equal ones the lowest level
// that it comes from. Nearer levels are passed on the way from farther ones, so two passes over the levels find it.
std::vector<Step> cheapest_steps(const std::vector<std::int64_t>& cost) {
  std::vector<Step> steps(cost.size());
  for (std::uint32_t to = 0; to < cost.size(); ++to) {
    steps[to] = {cost[to], to};
    if (to > 0 && steps[to - 1].cost + kLasting <= cost[to])
      steps[to] = {steps[to - 1].cost + kLasting, steps[to - 1].from};
  }
  Step above{cost.back(), static_cast<std::uint32_t>(cost.size() - 1)};
  for (std::size_t to = cost.size() - 1; to-- > 0;) {
    above.cost += kLasting;
    if (cost[to] <= above.cost) above = {cost[to], static_cast<std::uint32_t>(to)};
    if (above.cost < steps[to].cost) steps[to] = above;
  }
  return steps;
}

// The jumps of the piecewise constant function, from 0 to the last value, that fits `gap` best. Dynamic programming
// over (layer, level); the cost is the sum of the deviations plus kLasting for each jump by one.
std::vector<std::int32_t> lasting_jumps(const std::vector<std::int64_t>& gap) {
  const std::int64_t low = std::min<std::int64_t>(0, gap.back()) - kSlack;
  const auto levels = static_cast<std::size_t>(std::abs(gap.back()) + 2 * kSlack + 1);
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max() / 4;
  std::vector<std::int64_t> cost(levels, kNever);
  cost[static_cast<std::size_t>(-low)] = 0;
  std::vector<std::vector<Step>> steps;
  steps.reserve(gap.size());
  for (const std::int64_t value : gap) {
    const std::vector<Step>& last = steps.emplace_back(cheapest_steps(cost));
    for (std::size_t to = 0; to < levels; ++to) {
      cost[to] = last[to].cost + std::abs(value - (low + static_cast<std::int64_t>(to)));
    }
  }
  std::vector<std::int32_t> jumps;
  auto level = static_cast<std::size_t>(gap.back() - low);
  for (std::size_t i = gap.size(); i-- > 0;) {
    if (steps[i][level].from != level) jumps.push_back(static_cast<std::int32_t>(i));
    level = steps[i][level].from;
  }
  std::reverse(jumps.begin(), jumps.end());
  return jumps;
}

SampleLayers highest(const SampleLayers& a, const SampleLayers& b) {
  return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}

// Along each axis the first sample layer that is not below a point in mesh space.
SampleLayers layers_at(const Vec3& p, const Vec3& step, const std::array<std::int32_t, 3>& dims) {
  SampleLayers layers{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    layers[axis] = static_cast<std::int32_t>(std::clamp(std::ceil(p[axis] / step[axis]), 0.0, dims[axis] - 1.0));
  }
  return layers;
}

// Calls visit(part, layers, change) for every simplex: V - E + F of the part changes by this amount when planes along
// the three axes reach these layers. A simplex counts from the highest layers of its vertices on.
template <class Visit>
void for_each_change(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex, const Vec3& step,
                     const std::array<std::int32_t, 3>& dims, const Visit& visit) {
  // A vertex counts if a triangle uses it; its layers are computed then.
  constexpr std::int32_t kUnseen = -1;
  std::vector<SampleLayers> layers(mesh.points.size(), {kUnseen, 0, 0});
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const std::uint32_t part = part_of_vertex[v[0]];
    if (part == kNoPart) continue;
    for (const std::uint32_t q : v) {
      if (layers[q][0] != kUnseen) continue;
      layers[q] = layers_at(mesh.points[q], step, dims);
      visit(part, layers[q], 1);
    }
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide across = mesh.neighbours[t][i];  // an edge is counted at the larger of its two sides
      if (across != kNoSide && across > 4 * t + i) continue;
      visit(part, highest(layers[v[(i + 1) % 3]], layers[v[(i + 2) % 3]]), -1);
    }
    visit(part, highest(highest(layers[v[0]], layers[v[1]]), layers[v[2]]), 1);
  }
}

}  // namespace

void for_each_mesh_change(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex, const Vec3& step,
                          const std::array<std::int32_t, 3>& dims, const VisitChange& visit) {
  for_each_change(mesh, part_of_vertex, step, dims, visit);
}

std::vector<EulerCurves> euler_curves(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                                      std::size_t parts, const Vec3& step, const std::array<std::int32_t, 3>& dims) {
  EulerCurves none;
  for (std::size_t axis = 0; axis < 3; ++axis) none[axis].assign(static_cast<std::size_t>(dims[axis]), 0);
  std::vector<EulerCurves> changes(parts, none);
  for_each_change(mesh, part_of_vertex, step, dims,
                  [&](std::uint32_t part, const SampleLayers& at, std::int32_t change) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                      changes[part][axis][static_cast<std::size_t>(at[axis])] += change;
                    }
                  });
  for (EulerCurves& change : changes) {
    for (std::vector<std::int64_t>& along : change) std::partial_sum(along.begin(), along.end(), along.begin());
  }
  return changes;
}

std::array<std::vector<std::int32_t>, 3> jumps_between(const EulerCurves& mesh, const EulerCurves& exact) {
  std::array<std::vector<std::int32_t>, 3> jumps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<std::int64_t> gap = mesh[axis];
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] -= exact[axis][i];
    jumps[axis] = lasting_jumps(gap);
  }
  return jumps;
}

}  // namespace deliso
