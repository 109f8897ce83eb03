#include "volume/filters/finer_grid.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "volume/trilinear_cell.h"

namespace deliso {

std::optional<ScalarGrid> finer_grid(const ScalarGrid& grid, const SamplePart& part,
                                     const std::array<std::int32_t, 3>& times, std::int64_t most) {
  Dims dims{};
  double count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count *= double(part.dims[axis] - 1) * times[axis] + 1;
    if (count > double(most)) return std::nullopt;
    dims[axis] = (part.dims[axis] - 1) * times[axis] + 1;
  }
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        const std::array<std::int32_t, 3> at = {i, j, k};
        std::array<std::int32_t, 3> cell{};
        Vec3 uvw;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::int32_t step = std::min(at[axis] / times[axis], part.dims[axis] - 2);
          cell[axis] = part.low[axis] + step;
          uvw[axis] = double(at[axis] - step * times[axis]) / times[axis];
        }
        samples.push_back(trilinear_value(grid.cell(cell[0], cell[1], cell[2]), uvw));
      }
    }
  }
  return ScalarGrid(dims, Samples(std::move(samples)));
}

}  // namespace deliso
