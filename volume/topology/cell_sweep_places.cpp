// Rounded positions in a cell's sweep: nothing about the topology is decided here.
#include <algorithm>
#include <array>
#include <cmath>

#include "volume/topology/cell_sweep.h"

namespace deliso {

void CellSweep::scale_values() {
  double largest = std::abs(isovalue_);
  for (const double corner : corners_) largest = std::max(largest, std::abs(corner));
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  for (std::size_t c = 0; c < 8; ++c) {
    values_[c] = std::ldexp(corners_[c], exponent) - std::ldexp(isovalue_, exponent);
  }
}

double CellSweep::position(int end) const {
  if (end == kBottom) return 0;
  if (end == kTop) return 1;
  return value(end) / (value(end) - value(end + 4));
}

std::array<double, 4> CellSweep::slice_values(double w) const {
  std::array<double, 4> f;
  for (int corner = 0; corner < 4; ++corner) f[as_index(corner)] = (1 - w) * value(corner) + w * value(corner + 4);
  return f;
}

Vec3 CellSweep::slice_saddle(double w) const {
  const std::array<double, 4> f = slice_values(w);
  const double mixed = (f[0] - f[1]) + (f[3] - f[2]);
  if (mixed == 0) return {0.5, 0.5, w};
  return {std::clamp((f[0] - f[2]) / mixed, 0.0, 1.0), std::clamp((f[0] - f[1]) / mixed, 0.0, 1.0), w};
}

int CellSweep::piece_at(const Vec3& uvw) const {
  // The interval of the sweep that holds w.
  int interval = 0;
  while (interval < flip_count_ && position(flips_[as_index(interval)]) <= uvw.z) ++interval;
  const Slice& slice = history_[as_index(interval)];
  if (slice.above == 0 || slice.above == 0xFu) return -1;
  if (!slice.is_ambiguous()) {
    return *std::max_element(slice.piece_of_side.begin(), slice.piece_of_side.end());
  }
  // The bottom and the top side belong to different arcs, in opposite quadrants of the slice's saddle.
  const Vec3 saddle = slice_saddle(uvw.z);
  const double du = uvw.x - saddle.x;
  const double dv = uvw.y - saddle.y;
  const bool on_bottom_arc = slice.det_sign < 0 ? du + dv < 0 : dv - du < 0;
  return slice.piece_of_side[on_bottom_arc ? 0 : 1];
}

}  // namespace deliso
