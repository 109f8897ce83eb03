// Kinds of fields whose surfaces have parts thinner than a voxel.
#include <algorithm>
#include <cmath>

#include "tests/stress/stress_fields.h"
#include "tests/stress/stress_kinds.h"
#include "volume/topology/critical_points.h"

namespace deliso::testing {

namespace {

// The value outside a part of value 1 about this many voxels wide, for isovalue 0.
double outside_value(double width) { return -(2 / width - 1); }

// The value inside, with a little noise, and the same outside.
struct ThinField {
  ScalarGrid grid;
  template <class Inside>
  ThinField(Rng& rng, const Dims& dims, const Vec3& spacing, double width, const Inside& is_inside)
      : grid(float_grid(dims, spacing, [&](const Vec3& p) {
          return (is_inside(p) ? 1 : outside_value(width)) * rng.uniform(0.9, 1.1);
        })) {}
};

double thin_width(Rng& rng) { return rng.uniform(0.05, 0.2); }

bool is_one_in(Rng& rng, std::uint64_t n) { return rng.below(n) == 0; }

}  // namespace

// A tube along a row of samples, through the box or with ends inside it.
StressCase straight_tubes(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 8);
  const std::size_t axis = rng.below(3);
  const double from = double(rng.below(3)), to = double(dims[axis] - 1) - double(rng.below(2));
  const bool is_inverted = is_one_in(rng, 3);
  const auto is_on = [&](const Vec3& p) {
    return p[(axis + 1) % 3] == 2 && p[(axis + 2) % 3] == 1 && p[axis] >= from && p[axis] <= to;
  };
  ScalarGrid grid = ThinField(rng, dims, {1, 1, 1}, thin_width(rng), is_on).grid;
  if (!is_inverted) return {std::move(grid), 0};
  const ScalarGrid negative = float_grid(dims, {1, 1, 1}, [&](const Vec3& p) {
    return -grid.at(std::int32_t(p.x), std::int32_t(p.y), std::int32_t(p.z));
  });
  return {negative, 0};
}

// An L: two rows of samples that meet at a right angle; short or long arms.
StressCase bent_tubes(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 7);
  const std::size_t axis = rng.below(3), other = (axis + 1) % 3, third = (axis + 2) % 3;
  const double x = double(1 + rng.below(2)), y = double(1 + rng.below(2)), z = double(rng.below(2));
  const double reach_x = double(1 + rng.below(4)), reach_y = double(1 + rng.below(4));
  const auto is_on = [&](const Vec3& p) {
    if (p[third] != z) return false;
    const bool first = p[other] == y && p[axis] >= x && p[axis] <= x + reach_x;
    return first || (p[axis] == x && p[other] >= y && p[other] <= y + reach_y);
  };
  ScalarGrid grid = ThinField(rng, dims, {1, 1, 1}, thin_width(rng), is_on).grid;
  const double sign = is_one_in(rng, 3) ? -1 : 1;
  const ScalarGrid signed_grid = float_grid(dims, {1, 1, 1}, [&](const Vec3& p) {
    return sign * grid.at(std::int32_t(p.x), std::int32_t(p.y), std::int32_t(p.z));
  });
  return {signed_grid, 0};
}

// Balls thinner than a voxel around single samples.
StressCase specks(Rng& rng) {
  const double width = rng.uniform(0.01, 0.9), share = rng.uniform(0.01, 0.15);
  const Vec3 spacing{1, 1, is_one_in(rng, 3) ? rng.uniform(0.2, 1) : 1};
  return {
      ThinField(rng, small_dims(rng, 4, 7), spacing, width, [&](const Vec3&) { return rng.uniform() < share; }).grid,
      0};
}

// A sheet one sample thick: a plane, a box, or a ball's shell.
StressCase shells(Rng& rng) {
  const Dims dims = small_dims(rng, 6, 9);
  const Vec3 centre = 0.5 * Vec3{dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0};
  const double radius = rng.uniform(1.2, 2.6);
  const std::uint64_t form = rng.below(3);
  const auto is_on = [&](const Vec3& p) {
    const Vec3 d = p - centre;
    if (form == 0) return p.z == 2;
    if (form == 1) return std::abs(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) - radius) < 0.5;
    return std::abs(norm(d) - radius) < 0.5;
  };
  return {ThinField(rng, dims, {1, 1, 1}, thin_width(rng), is_on).grid, 0};
}

// Rows and single samples on the faces and edges of the box.
StressCase box_needles(Rng& rng) {
  const Dims dims = small_dims(rng, 4, 7);
  const std::size_t axis = rng.below(3);
  const bool is_edge = is_one_in(rng, 2);
  const double from = double(rng.below(3)), to = from + double(rng.below(4)), share = rng.uniform(0, 0.1);
  const auto is_on = [&](const Vec3& p) {
    if (p[(axis + 1) % 3] != 0) return false;
    const bool on_row = p[(axis + 2) % 3] == (is_edge ? 0 : 2) && p[axis] >= from && p[axis] <= to;
    return on_row || rng.uniform() < share;
  };
  const double width = std::pow(10, rng.uniform(-4, -0.7));
  return {ThinField(rng, dims, {1, 1, 1}, width, is_on).grid, 0, is_one_in(rng, 4)};
}

// Smooth noise with an isovalue that is that of a saddle but for a little: necks and gaps as thin as rounding.
StressCase squeezed_necks(Rng& rng) {
  const bool is_smooth = is_one_in(rng, 2);
  const auto wave = random_waves(rng, 0.5, 1.5);
  ScalarGrid grid = double_grid(small_dims(rng, 5, 7), {1, 1, 1}, [&](const Vec3& p) {
    return is_smooth ? wave(p) + 0.2 * rng.uniform() : rng.uniform(-1, 1);
  });
  std::vector<CriticalPoint> saddles;
  for (std::int32_t i = 0; i + 1 < grid.dims()[0]; ++i) append_critical_points(grid.cell(i, 2, 2), saddles);
  const double saddle = saddles.empty() ? 0.1 : saddles[rng.below(saddles.size())].value;
  const double off = random_magnitude(rng, -14, -2);
  return {std::move(grid), saddle + off};
}

}  // namespace deliso::testing
