// A scalar volume: samples on a regular grid, kept in their own type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"

namespace deliso {

using Samples =
    std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::uint16_t>,
                 std::vector<std::int16_t>, std::vector<std::int32_t>, std::vector<float>, std::vector<double>>;

// Number of samples along x, y, z; each at least 2 in a valid grid.
using Dims = std::array<std::int32_t, 3>;

// The eight samples of a voxel cell; corner i + 2j + 4k is the sample at offset (i, j, k).
using CellCorners = std::array<double, 8>;

// Samples in x-fastest order. Sample (i, j, k) sits in the world at origin + (i sx, j sy, k sz).
class ScalarGrid {
 public:
  // Throws InputError when a dimension is below 2, the sample count does not fit dims, a spacing is not positive and
  // finite, or a sample is NaN or infinite (naming the first).
  ScalarGrid(Dims dims, Samples samples, Vec3 spacing = {1, 1, 1}, Vec3 origin = {0, 0, 0});

  [[nodiscard]] const Dims& dims() const { return dims_; }
  [[nodiscard]] const Vec3& spacing() const { return spacing_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] const Samples& samples() const { return samples_; }
  [[nodiscard]] std::size_t sample_count() const;
  [[nodiscard]] std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(dims_[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(dims_[1]) * static_cast<std::size_t>(k));
  }
  [[nodiscard]] double at(std::int32_t i, std::int32_t j, std::int32_t k) const;
  // The samples of the cell with lowest corner (i, j, k); 0 <= i < dims[0] - 1 and so on. One switch, eight loads.
  [[nodiscard]] CellCorners cell(std::int32_t i, std::int32_t j, std::int32_t k) const;
  // "u8", "i8", "u16", "i16", "i32", "f32" or "f64".
  [[nodiscard]] std::string type_name() const;
  // Smallest and largest sample.
  [[nodiscard]] std::pair<double, double> range() const { return range_; }

 private:
  Dims dims_;
  Vec3 spacing_;
  Vec3 origin_;
  Samples samples_;
  std::pair<double, double> range_;
};

// The same samples with a layer of `value` around them (the origin moves out by one spacing): every isosurface with an
// isovalue above `value` is then closed. `value` is converted to the grid's type.
ScalarGrid padded(const ScalarGrid& grid, double value);

// A regular isovalue: `isovalue` itself unless some sample equals it; then it is lowered by 1 % of the gap to the next
// lower sample value (or, when there is none, of the gap to the next higher one).
double regular_isovalue(const ScalarGrid& grid, double isovalue);

}  // namespace deliso
