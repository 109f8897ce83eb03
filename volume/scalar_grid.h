// A scalar volume: samples on a regular grid, kept in their own type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "volume/sample_array.h"

namespace deliso {

using Samples =
    std::variant<SampleArray<std::uint8_t>, SampleArray<std::int8_t>, SampleArray<std::uint16_t>,
                 SampleArray<std::int16_t>, SampleArray<std::int32_t>, SampleArray<float>, SampleArray<double>>;

// Number of samples along x, y, z; each at least 2 in a valid grid.
using Dims = std::array<std::int32_t, 3>;

// The eight samples of a voxel cell; corner i + 2j + 4k is the sample at offset (i, j, k).
using CellCorners = std::array<double, 8>;

// Calls `f` with the array of samples in its own type; for loops over whole volumes.
template <class Function>
decltype(auto) visit_samples(const Samples& samples, Function&& f);

// Samples in x-fastest order. Sample (i, j, k) sits in the world at origin + (i sx, j sy, k sz).
class ScalarGrid {
 public:
  // Throws InputError when a dimension is below 2, the sample count does not fit dims, a spacing is not positive or
  // outside 1e-100 to 1e100, the box lies so far from the origin that coordinates cannot resolve 1e-4 of the smallest
  // spacing, or a sample is NaN or infinite (naming the first).
  ScalarGrid(Dims dims, Samples samples, Vec3 spacing = {1, 1, 1}, Vec3 origin = {0, 0, 0});

  [[nodiscard]] const Dims& dims() const { return dims_; }
  [[nodiscard]] const Vec3& spacing() const { return spacing_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] const Samples& samples() const { return samples_; }
  [[nodiscard]] std::size_t sample_count() const { return index(0, 0, dims_[2]); }
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
  // The box of the samples in the world.
  [[nodiscard]] Box3 box() const;
  // Where the isosurface has been closed along the faces of a box (filters/closing.h): that box, in the world. What is
  // on a face of it within rounding is on it.
  [[nodiscard]] const std::optional<Box3>& walls() const { return walls_; }
  void set_walls(const Box3& walls) { walls_ = walls; }
  // Along which axes the samples lie in reverse order to that of their file, which counts them from the other end.
  // Regions (region.h) and messages that name a sample count as the file does.
  [[nodiscard]] const std::array<bool, 3>& backwards() const { return backwards_; }
  void set_backwards(const std::array<bool, 3>& axes) { backwards_ = axes; }

 private:
  void check_places() const;
  template <class Sample>
  [[nodiscard]] CellCorners gather(const SampleArray<Sample>& samples, std::size_t first) const;

  Dims dims_;
  Vec3 spacing_;
  Vec3 origin_;
  Samples samples_;
  std::pair<double, double> range_;
  std::optional<Box3> walls_;
  std::array<bool, 3> backwards_{};
};

// The same samples with a layer of `value` around them (the origin moves out by one spacing): every isosurface with an
// isovalue above `value` is then closed. `value` is converted to the grid's type: rounded down, then clamped to the
// type's range. Throws InputError when `value` is NaN or a dimension would leave the range of Dims.
ScalarGrid padded(const ScalarGrid& grid, double value);

// The number of samples of a grid with these dims. Throws InputError when a dimension is below 2, or when the samples,
// at eight bytes each, could not be addressed.
std::size_t checked_sample_count(const Dims& dims);

// ---- Inline: the ray caster reads cells in its innermost loop -------------------------------------------------------

template <class Function>
decltype(auto) visit_samples(const Samples& samples, Function&& f) {
  switch (samples.index()) {
    case 0:
      return f(*std::get_if<0>(&samples));
    case 1:
      return f(*std::get_if<1>(&samples));
    case 2:
      return f(*std::get_if<2>(&samples));
    case 3:
      return f(*std::get_if<3>(&samples));
    case 4:
      return f(*std::get_if<4>(&samples));
    case 5:
      return f(*std::get_if<5>(&samples));
    default:
      return f(*std::get_if<6>(&samples));
  }
}

template <class Sample>
CellCorners ScalarGrid::gather(const SampleArray<Sample>& samples, std::size_t first) const {
  const auto row = static_cast<std::size_t>(dims_[0]);
  const Sample* a = samples.data() + first;
  const Sample* b = a + row * static_cast<std::size_t>(dims_[1]);
  const auto value = [](Sample sample) { return static_cast<double>(sample); };
  return {value(a[0]), value(a[1]), value(a[row]), value(a[row + 1]),
          value(b[0]), value(b[1]), value(b[row]), value(b[row + 1])};
}

inline double ScalarGrid::at(std::int32_t i, std::int32_t j, std::int32_t k) const {
  return visit_samples(samples_, [n = index(i, j, k)](const auto& samples) { return static_cast<double>(samples[n]); });
}

inline CellCorners ScalarGrid::cell(std::int32_t i, std::int32_t j, std::int32_t k) const {
  return visit_samples(samples_,
                       [this, first = index(i, j, k)](const auto& samples) { return gather(samples, first); });
}

}  // namespace deliso
