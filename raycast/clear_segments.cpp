// Quick queries of an isosurface: on which side a point lies, and whether a segment can meet the surface.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "raycast/active_cells.h"
#include "raycast/empty_bricks.h"
#include "raycast/isosurface.h"

namespace deliso {

namespace {

// The longest side of a box of cells that is searched for active cells without a ray.
constexpr std::int32_t kMostCells = 7;
// A segment is examined in at most two to this power pieces.
constexpr int kMostHalvings = 3;

// The three coordinates of a position and a fourth number in one register (a vector type of GCC and Clang).
using Ints = std::int32_t __attribute__((vector_size(16)));
Ints ints(const Isosurface::Place& place) {
  static_assert(sizeof(place) == sizeof(Ints));
  Ints result;
  std::memcpy(&result, &place, sizeof(result));
  return result;
}

}  // namespace

Isosurface::Place Isosurface::place_of(const Vec3& p) const {
  if (bricks_ == nullptr) return {};
  const Dims& dims = grid_.dims();
  const Vec3 point = scaled(p, inverse_step_);
  const Cell cell = {extended_cell(point.x, dims[0]), extended_cell(point.y, dims[1]), extended_cell(point.z, dims[2])};
  return {cell, bricks_->clearance(cell)};
}

void Isosurface::prefetch(const Place& place) const {
  if (bricks_ == nullptr || place.clearance != 0) return;  // far from the isosurface no other memory is read
  active_->prefetch(place.cell);
  const Dims& dims = grid_.dims();
  const Cell base = grid_cell(place.cell, dims);
  const std::size_t first = grid_.index(base[0], base[1], base[2]);
  const auto row = static_cast<std::size_t>(dims[0]);
  const std::size_t slice = row * static_cast<std::size_t>(dims[1]);
  visit_samples(grid_.samples(), [&](const auto& samples) {
    for (const std::size_t sample : {first, first + row, first + slice, first + slice + row}) {
      __builtin_prefetch(samples.data() + sample);
    }
  });
}

bool Isosurface::is_clear_box(const Place& a, const Place& b) const {
  if (bricks_ == nullptr) return false;
  if (EmptyBricks::is_empty_between(a.cell, a.clearance, b.cell, b.clearance)) return true;
  // Which cell is the lower one is unpredictable: all axes at once, without branches.
  const Ints ahead = ints(b) - ints(a);
  const Ints back = ahead & (ahead >> 31);  // 0 unless the segment runs backward
  const Ints low = ints(a) + back;
  const Ints high = ints(b) - back;
  const Ints spare = kMostCells - (high - low);  // negative where the box is too long
  if ((spare[0] | spare[1] | spare[2]) < 0) return false;
  return !active_->any_active({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
}

bool Isosurface::is_clear(const Vec3& a, const Place& place_a, const Vec3& b, const Place& place_b) const {
  return bricks_ != nullptr && is_clear(a, place_a, b, place_b, kMostHalvings);
}

bool Isosurface::is_clear(const Vec3& a, const Place& place_a, const Vec3& b, const Place& place_b,
                          int halvings) const {
  if (is_clear_box(place_a, place_b)) return true;
  if (halvings == 0 || (place_a.clearance == 0 && active_->is_active(place_a.cell)) ||
      (place_b.clearance == 0 && active_->is_active(place_b.cell))) {
    return false;
  }
  const Vec3 middle = 0.5 * (a + b);
  const Place place = place_of(middle);
  return is_clear(a, place_a, middle, place, halvings - 1) && is_clear(middle, place, b, place_b, halvings - 1);
}

}  // namespace deliso
