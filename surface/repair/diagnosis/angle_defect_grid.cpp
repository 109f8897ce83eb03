#include "surface/repair/diagnosis/angle_defect_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace deliso {

namespace {

// Samples from node to node. A window is three nodes wide; a vertex counts with the weights of a B-spline.
constexpr std::int32_t kSpacing = 4;
// A handle too many or too few changes the sum by 2. A window may hold only a part of that.
constexpr float kLeast = 1;
// Windows nearer to each other than this (in nodes, along the axis of the largest distance) show the same place.
constexpr std::int32_t kCloseNodes = 2;

// The weights of a quadratic B-spline at three nodes in a row, the point lying `u` (-1/2 to 1/2) from the middle one.
std::array<float, 3> weights(double u) {
  return {static_cast<float>(0.5 * (0.5 - u) * (0.5 - u)), static_cast<float>(0.75 - u * u),
          static_cast<float>(0.5 * (0.5 + u) * (0.5 + u))};
}

// Replaces each entry by its sum with the entries before and behind it, along an axis with this stride.
std::vector<float> sums_of_three(const std::vector<float>& values, std::size_t stride) {
  std::vector<float> sums = values;
  for (std::size_t i = 0; i + stride < values.size(); ++i) {
    sums[i] += values[i + stride];
    sums[i + stride] += values[i];
  }
  return sums;
}

}  // namespace

AngleDefectGrid::AngleDefectGrid(const std::array<std::int32_t, 3>& dims, const Vec3& step) : dims_(dims) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nodes_per_unit_[axis] = 1 / (kSpacing * step[axis]);
    // Two nodes below the first sample and two above the last one, so that sums of three stay within the array.
    nodes_[axis] = static_cast<std::size_t>((dims[axis] + kSpacing - 2) / kSpacing) + 5;
  }
  sums_.assign(nodes_[0] * nodes_[1] * nodes_[2], 0);
}

void AngleDefectGrid::add(const SurfaceMesh& mesh, const std::function<bool(std::uint32_t)>& is_taken) {
  constexpr double kTurn = 2 * std::numbers::pi;
  // In turns: the sum of the angles at each vertex, and half a turn for a vertex of the boundary.
  std::vector<float> filled(mesh.points.size(), -1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (!is_taken(v[0])) continue;
    for (const std::uint32_t q : v) filled[q] = std::max(filled[q], 0.0F);
    // Two angles by the same cross product; the third one is what they lack to half a turn.
    const Vec3 ab = mesh.points[v[1]] - mesh.points[v[0]], ac = mesh.points[v[2]] - mesh.points[v[0]];
    const double twice_area = norm(cross(ab, ac));
    const double at_a = std::atan2(twice_area, dot(ab, ac)) / kTurn;
    const double at_b = std::atan2(twice_area, dot(ab, ab) - dot(ab, ac)) / kTurn;
    filled[v[0]] += static_cast<float>(at_a);
    filled[v[1]] += static_cast<float>(at_b);
    filled[v[2]] += static_cast<float>(0.5 - at_a - at_b);
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.neighbours[t][i] != kNoSide) continue;
      filled[v[(i + 1) % 3]] += 0.25F;
      filled[v[(i + 2) % 3]] += 0.25F;
    }
  }
  for (std::size_t v = 0; v < filled.size(); ++v) {
    if (filled[v] >= 0) spread(mesh.points[v], 1 - filled[v]);
  }
}

void AngleDefectGrid::subtract(const AngleDefectGrid& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] -= other.sums_[i];
}

void AngleDefectGrid::spread(const Vec3& p, float amount) {
  std::array<std::size_t, 3> first{};
  std::array<std::array<float, 3>, 3> weight;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(nodes_[axis] - 3);
    const double at = std::clamp(p[axis] * nodes_per_unit_[axis] + 2, 2.0, last);
    const double middle = std::floor(at + 0.5);
    weight[axis] = weights(at - middle);
    first[axis] = static_cast<std::size_t>(middle) - 1;
  }
  for (std::size_t z = 0; z < 3; ++z) {
    for (std::size_t y = 0; y < 3; ++y) {
      float* const row = &sums_[first[0] + nodes_[0] * (first[1] + y + nodes_[1] * (first[2] + z))];
      for (std::size_t x = 0; x < 3; ++x) row[x] += amount * weight[0][x] * weight[1][y] * weight[2][z];
    }
  }
}

std::vector<float> AngleDefectGrid::window_sums() const {
  return sums_of_three(sums_of_three(sums_of_three(sums_, 1), nodes_[0]), nodes_[0] * nodes_[1]);
}

std::vector<IndexBox> AngleDefectGrid::places(bool is_positive, std::size_t most) const {
  struct Window {
    float sum;
    std::array<std::int32_t, 3> node;
  };
  const std::vector<float> sums = window_sums();
  std::vector<Window> windows;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float sum = is_positive ? sums[i] : -sums[i];
    if (sum < kLeast) continue;
    const std::size_t row = i / nodes_[0];
    windows.push_back({sum,
                       {static_cast<std::int32_t>(i % nodes_[0]), static_cast<std::int32_t>(row % nodes_[1]),
                        static_cast<std::int32_t>(row / nodes_[1])}});
  }
  std::stable_sort(windows.begin(), windows.end(), [](const Window& a, const Window& b) { return a.sum > b.sum; });

  std::vector<std::array<std::int32_t, 3>> taken;
  std::vector<IndexBox> places;
  for (const Window& window : windows) {
    if (places.size() == most) break;
    const auto is_close = [&](const auto& other) {
      std::int32_t farthest = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        farthest = std::max(farthest, std::abs(other[axis] - window.node[axis]));
      }
      return farthest <= kCloseNodes;
    };
    if (std::any_of(taken.begin(), taken.end(), is_close)) continue;
    taken.push_back(window.node);
    IndexBox& place = places.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t middle = kSpacing * (window.node[axis] - 2), last = dims_[axis] - 1;
      place[axis] = {std::clamp(middle - kSpacing / 2, 0, last), std::clamp(middle + kSpacing / 2, 0, last)};
    }
  }
  return places;
}

}  // namespace deliso
