#include "surface/verification/facing_votes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "surface/certificate/promise.h"

namespace deliso {

namespace {

// A component that follows the isosurface has few passes against it, in folds. Where sheets are thinner than the mesh
// may be off, whole triangles may lie on the other side of samples; one that is reversed has far more.
constexpr std::int64_t kMostAgainst = 2;  // for each pass towards lower values
constexpr double kLineOffset = 0x1p-12;   // voxels from a grid edge to the lines beside it

// Where a line parallel to `axis` through `on_line` meets a triangle; nothing where it passes beside it.
std::optional<double> pass_of(const std::array<Vec3, 3>& corners, const Vec3& on_line, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<double, 3> weight{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = corners[(i + 1) % 3] - on_line, b = corners[(i + 2) % 3] - on_line;
    weight[i] = a[u] * b[v] - a[v] * b[u];
  }
  const bool is_inside =
      (weight[0] > 0 && weight[1] > 0 && weight[2] > 0) || (weight[0] < 0 && weight[1] < 0 && weight[2] < 0);
  if (!is_inside) return std::nullopt;
  const double sum = weight[0] + weight[1] + weight[2];
  return (weight[0] * corners[0][axis] + weight[1] * corners[1][axis] + weight[2] * corners[2][axis]) / sum;
}

// Passes of a component: towards lower values, and towards higher ones. And the area that faces down the gradient, less
// that which faces up: where sheets are thin passes alone would call right components reversed, and across bends of
// thin tubes areas alone would.
struct Votes {
  std::int64_t down = 0, up = 0;
  double area_down = 0;
};

// By the sides of the nearest two points, before and behind the middle of the triangle, that lie on different ones:
// beside a crease, as where a volume is closed, the gradient may be that of the wrong cell. Where there are none, by
// the gradient.
double area_down(const std::array<Vec3, 3>& corners, const IsosurfaceProbe& probe) {
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = norm(normal);
  for (const double away : {0x1p-9, 0x1p-6, 0x1p-3}) {
    if (!(area > 0)) break;
    const Vec3 offset = (away / area) * normal;
    const bool is_below_before = probe.value(middle + offset) < 0, is_below_behind = probe.value(middle - offset) < 0;
    if (is_below_before != is_below_behind) return is_below_before ? area : -area;
  }
  const Vec3 gradient = probe.gradient(middle);
  const double steepness = norm_of_any_size(gradient);
  if (!(steepness > 0)) return 0;
  return -dot(normal, gradient / steepness);
}

// The vote of a triangle at its pass of a line beside a grid edge. The line's ends have to lie on the sides that the
// edge's samples lie on: else the isosurface runs along the edge, and not across it.
int vote(const std::array<Vec3, 3>& corners, const Vec3& on_edge, const Vec3& on_line, std::size_t axis,
         const IsosurfaceProbe& probe) {
  const std::optional<double> at = pass_of(corners, on_line, axis);
  if (!at) return 0;
  const double step = probe.step()[axis], last = std::round(probe.box().high[axis] / step);
  const double low = std::clamp(std::floor(*at / step), 0.0, last - 1);
  const double from = low * step, to = (low + 1) * step, least = Promise().max_residual;
  if (*at - from <= least || to - *at <= least) return 0;
  const auto is_below = [&](Vec3 p, double end) {
    p[axis] = end;
    return probe.value(p) < 0;
  };
  const bool before = is_below(on_edge, from), behind = is_below(on_edge, to);
  if (before == behind || is_below(on_line, from) != before || is_below(on_line, to) != behind) return 0;
  const double along = cross(corners[1] - corners[0], corners[2] - corners[0])[axis];
  if (along == 0) return 0;
  return (along > 0) == behind ? 1 : -1;
}

// Adds those at the lines that may meet a triangle.
void add_votes(const std::array<Vec3, 3>& corners, std::size_t axis, const IsosurfaceProbe& probe, Votes& votes) {
  Box3 box{corners[0], corners[0]};
  for (const Vec3& p : corners) box.extend(p);
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3& step = probe.step();
  const auto first = [&](std::size_t a) {
    // Beyond the box there is no line, and the number of one might be too large for an integer.
    return static_cast<std::int64_t>(
        std::min(std::max(0.0, box.low[a] - kLineOffset), probe.box().high[a] + 2 * step[a]) / step[a]);
  };
  const auto last = [&](std::size_t a) {
    return static_cast<std::int64_t>(
        std::max(0.0, std::min(box.high[a] + kLineOffset, probe.box().high[a] + 0.5 * step[a]) / step[a]));
  };
  for (auto i = first(u), last_i = last(u); i <= last_i; ++i) {
    for (auto j = first(v), last_j = last(v); j <= last_j; ++j) {
      for (const double side_u : {-kLineOffset, kLineOffset}) {
        for (const double side_v : {-kLineOffset, kLineOffset}) {
          Vec3 on_edge;
          on_edge[u] = static_cast<double>(i) * step[u];
          on_edge[v] = static_cast<double>(j) * step[v];
          Vec3 on_line = on_edge;
          on_line[u] += side_u;
          on_line[v] += side_v;
          if (!probe.box().contains(on_line)) continue;
          const int its = vote(corners, on_edge, on_line, axis, probe);
          votes.down += its > 0 ? 1 : 0;
          votes.up += its < 0 ? 1 : 0;
        }
      }
    }
  }
}

// Triangles of a mesh as coarse as its sheets are thin lie beyond the next sheet all over, but for their corners, which
// lie on the isosurface: a component that faces down the gradients at its corners is right.
void forgive_coarse(const TriangleMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
                    const IsosurfaceProbe& probe, std::vector<bool>& are_against) {
  if (std::find(are_against.begin(), are_against.end(), true) == are_against.end()) return;
  std::vector<double> down(are_against.size(), 0);
  for (const auto& corners : mesh.triangles) {
    const std::uint32_t component = component_of_vertex[corners[0]];
    if (!are_against[component]) continue;
    const Vec3& a = mesh.points[corners[0]];
    const Vec3 normal = cross(mesh.points[corners[1]] - a, mesh.points[corners[2]] - a);
    for (const std::uint32_t v : corners) {
      const Vec3 gradient = probe.gradient(mesh.points[v]);
      const double steepness = norm_of_any_size(gradient);
      if (steepness > 0) down[component] -= dot(normal, gradient / steepness);
    }
  }
  for (std::size_t i = 0; i < down.size(); ++i) are_against[i] = are_against[i] && !(down[i] > 0);
}

// The solid angle of a triangle, as parts of a whole turn, above 0 where it faces away from the point (Van Oosterom and
// Strackee, The solid angle of a plane triangle, 1983). The mesher has its own: a mistake is not to blind both.
double turn_around(const Vec3& from, const std::array<Vec3, 3>& corners) {
  const Vec3 a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
  const double to_a = norm(a), to_b = norm(b), to_c = norm(c);
  const double beside = to_a * to_b * to_c + dot(a, b) * to_c + dot(b, c) * to_a + dot(c, a) * to_b;
  return std::atan2(dot(a, cross(b, c)), beside) / (2 * std::numbers::pi);
}

// Components that few lines tell of lie beside samples: they wind around these, half around those that they pass by,
// and by an eighth in a corner of the box. Where that does not say clearly that they face the wrong way, they are
// right.
void forgive_around_samples(const TriangleMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
                            const IsosurfaceProbe& probe, std::vector<bool>& are_against) {
  if (std::find(are_against.begin(), are_against.end(), true) == are_against.end()) return;
  constexpr std::size_t kMostSamples = 64;
  constexpr double kLeastTurn = 1.0 / 16;
  std::vector<std::vector<std::array<Vec3, 3>>> triangles(are_against.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t component = component_of_vertex[a];
    if (are_against[component]) triangles[component].push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::set<std::array<double, 3>> samples;
    const std::size_t stride = triangles[i].size() / kMostSamples + 1;
    for (std::size_t t = 0; t < triangles[i].size(); t += stride) {
      const Vec3& p = triangles[i][t][0];
      const Vec3& step = probe.step();
      samples.insert(
          {std::round(p.x / step.x) * step.x, std::round(p.y / step.y) * step.y, std::round(p.z / step.z) * step.z});
    }
    double agree = 0;
    for (const auto& [x, y, z] : samples) {
      double turns = 0;
      for (const auto& corners : triangles[i]) turns += turn_around({x, y, z}, corners);
      agree += probe.value({x, y, z}) < 0 ? -turns : turns;
    }
    are_against[i] = are_against[i] && agree < -kLeastTurn;
  }
}

}  // namespace

std::vector<std::int64_t> facing_votes(const TriangleMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
                                       std::size_t components, const IsosurfaceProbe& probe) {
  std::vector<Votes> votes(components);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Vec3, 3> corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    for (std::size_t axis = 0; axis < 3; ++axis) add_votes(corners, axis, probe, votes[component_of_vertex[a]]);
    votes[component_of_vertex[a]].area_down += area_down(corners, probe);
  }
  std::vector<bool> are_against(components), are_doubtful(components);
  for (std::size_t i = 0; i < components; ++i) {
    // Few lines tell or none where most of the component lies as near to samples as vertices may be off.
    const auto& [down, up, area] = votes[i];
    are_against[i] = up > kMostAgainst * down && area < 0;
    are_doubtful[i] = down <= kMostAgainst * up && area < 0;
  }
  forgive_around_samples(mesh, component_of_vertex, probe, are_doubtful);
  for (std::size_t i = 0; i < components; ++i) are_against[i] = are_against[i] || are_doubtful[i];
  forgive_coarse(mesh, component_of_vertex, probe, are_against);
  std::vector<std::int64_t> sums;
  for (std::size_t i = 0; i < components; ++i) {
    const std::int64_t sum = votes[i].down - votes[i].up;
    sums.push_back(are_against[i] ? std::min<std::int64_t>(-1, sum) : std::max<std::int64_t>(0, sum));
  }
  return sums;
}

}  // namespace deliso
