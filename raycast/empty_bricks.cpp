#include "raycast/empty_bricks.h"

#include <algorithm>

#include "delaunay/base/parallel.h"

namespace deliso {

namespace {

// Distances along a line of bricks to the nearest brick with distance 0, at most `farthest`.
void spread_along_row(std::int8_t* row, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) row[i] = std::min(row[i], static_cast<std::int8_t>(row[i - 1] + 1));
  for (std::size_t i = count - 1; i > 0; --i) {
    row[i - 1] = std::min(row[i - 1], static_cast<std::int8_t>(row[i] + 1));
  }
}

// For every line of `count` rows of `width` bricks, `stride` apart: out[i] = min over j of max(|i - j|, in[j]). This
// extends the largest-coordinate distance by one axis.
void spread_across_rows(const std::int8_t* in, std::int8_t* out, std::size_t count, std::size_t stride,
                        std::size_t width, int farthest) {
  for (std::size_t i = 0; i < count; ++i) {
    std::int8_t* const best = out + i * stride;
    const auto take = [&](std::size_t j, int apart) {
      const std::int8_t* const other = in + j * stride;
      const auto least = static_cast<std::int8_t>(apart);
      for (std::size_t x = 0; x < width; ++x) best[x] = std::min(best[x], std::max(other[x], least));
    };
    for (int apart = 1; apart < farthest; ++apart) {
      const auto step = static_cast<std::size_t>(apart);
      if (step <= i) take(i - step, apart);
      if (i + step < count) take(i + step, apart);
    }
  }
}

}  // namespace

EmptyBricks::EmptyBricks(const ScalarGrid& grid, const ActiveCells& active, double isovalue, int threads)
    : dims_(grid.dims()) {
  for (std::size_t a = 0; a < 3; ++a) bricks_[a] = (static_cast<std::size_t>(dims_[a]) >> kShift) + 1;
  const auto [nx, ny, nz] = bricks_;
  const std::size_t layer = nx * ny;
  clearance_.assign(layer * nz, kFarthest);
  // The largest-coordinate distance, axis by axis: along x and y layer by layer,
  run_tasks(nz, threads, [&, nx = nx, ny = ny](std::size_t z) {
    std::int8_t* const first = clearance_.data() + layer * z;
    for (std::size_t y = 0; y < ny; ++y) {
      for (std::size_t x = 0; x < nx; ++x)
        if (active.brick({brick_cell(x), brick_cell(y), brick_cell(z)}) != 0) first[y * nx + x] = 0;
      spread_along_row(first + y * nx, nx);
    }
    const std::vector<std::int8_t> before(first, first + layer);
    spread_across_rows(before.data(), first, ny, nx, nx, kFarthest);
  });
  // then along z, one row of each layer at a time; and the signs.
  const std::vector<std::int8_t> before = clearance_;
  run_tasks(ny, threads, [&, nx = nx, nz = nz](std::size_t y) {
    spread_across_rows(before.data() + y * nx, clearance_.data() + y * nx, nz, layer, nx, kFarthest);
    for (std::size_t z = 0; z < nz; ++z) set_signs(grid, isovalue, y, z);
  });
}

// The signs of any sample of each brick of a row; cell e has samples e - 1 and e.
void EmptyBricks::set_signs(const ScalarGrid& grid, double isovalue, std::size_t y, std::size_t z) {
  const auto sample = [&](std::size_t axis, std::size_t brick) { return std::min(brick_cell(brick), dims_[axis] - 1); };
  for (std::size_t x = 0; x < bricks_[0]; ++x) {
    if (grid.at(sample(0, x), sample(1, y), sample(2, z)) > isovalue) continue;
    std::int8_t& clearance = clearance_[index(x, y, z)];
    clearance = static_cast<std::int8_t>(-clearance);
  }
}

}  // namespace deliso
