// At which of the places where sweeps along the axes see a mesh and the surface part they do.
//
// A sweep tells a layer. Where it takes several layers along each axis, all their crossings are places, and most of
// them are places by chance. In a box around one with a handle more or less the mesh and the surface have other Euler
// characteristics, counting each simplex where the highest layers of its vertices are. They also do where the sides of
// the box cut what differs in shape only. So boxes of several sizes vote.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "surface/repair/diagnosis/index_ranges.h"

namespace deliso {

class EulerBoxes {
 public:
  // `layers`: along each axis, ascending, in a volume with so many samples. None when one is empty or there would be
  // too many boxes.
  static std::optional<EulerBoxes> around(const std::array<std::vector<std::int32_t>, 3>& layers,
                                          const std::array<std::int32_t, 3>& dims);

  [[nodiscard]] std::size_t count() const { return ranges_[0].size() * ranges_[1].size() * ranges_[2].size(); }
  // Whether something at this layer may count, whatever its layers along the other axes.
  [[nodiscard]] bool reach(std::size_t axis, std::int32_t layer) const {
    const Near& near = near_.back()[axis][static_cast<std::size_t>(layer)];
    return near.begin < near.end;
  }
  // Something that counts from these layers on, in the mesh, or with the other sign on the surface.
  void add(const std::array<std::int32_t, 3>& layers, std::int32_t amount);
  // All, and as the likely ones those where what has been added is not zero, by the median of the sizes.
  [[nodiscard]] IndexRanges places() const;

 private:
  [[nodiscard]] bool differs(std::size_t box) const;

  static constexpr std::size_t kSizes = 5;

  std::array<std::vector<LayerRange>, 3> ranges_;  // along each axis; layers that are close are one
  // Along each axis, of each layer: the first of the ranges that are near it, and one beyond the last.
  struct Near {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  std::array<std::array<std::vector<Near>, 3>, kSizes> near_;
  std::array<std::vector<std::int32_t>, kSizes> sums_;  // of each box
};

}  // namespace deliso
