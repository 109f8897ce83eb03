#include "experiments/runs/isosurface_samples.h"

#include <algorithm>
#include <array>
#include <optional>

namespace deliso {
namespace {

// Where the isosurface crosses the middle line of a cell, from 0 to 1.
std::optional<double> crossing(const CellCorners& corners, unsigned axis, double isovalue) {
  std::array<double, 2> ends = {0, 0};  // means of opposite faces
  for (unsigned corner = 0; corner < 8; ++corner) ends[corner >> axis & 1u] += corners[corner] / 4;
  if ((ends[0] < isovalue) == (ends[1] < isovalue)) return std::nullopt;
  return (isovalue - ends[0]) / (ends[1] - ends[0]);
}

}  // namespace

std::vector<Vec3> isosurface_samples(const ScalarGrid& grid, double isovalue) {
  std::vector<Vec3> points;
  const Dims& dims = grid.dims();
  const auto in_world = [&grid](double i, double j, double k) {
    const Vec3& step = grid.spacing();
    return grid.origin() + Vec3{i * step.x, j * step.y, k * step.z};
  };
  for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < dims[0]; ++i) {
        const CellCorners corners = grid.cell(i, j, k);
        const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
        if (*high < isovalue || *low >= isovalue) continue;
        for (unsigned axis = 0; axis < 3; ++axis) {
          const std::optional<double> t = crossing(corners, axis, isovalue);
          if (!t) continue;
          Vec3 local{0.5, 0.5, 0.5};
          local[axis] = *t;
          points.push_back(in_world(i + local.x, j + local.y, k + local.z));
        }
      }
    }
  }
  return points;
}

}  // namespace deliso
