// Which of the boxes in which jumps of Euler curves meet contain a difference.
//
// A jump gives a layer along its axis. If there are several jumps along each axis, they meet in many boxes, and most of
// these contain no difference. In a box with an additional or missing handle the mesh and the surface have different
// Euler characteristics, if each simplex counts where the highest layers of its vertices are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "surface/repair/diagnosis/euler_curve.h"
#include "surface/repair/diagnosis/index_ranges.h"

namespace deliso {

class EulerBoxes {
 public:
  // `jumps`: along each axis, ascending, in a volume with so many samples. Nothing if an axis has no jump, or if there
  // would be more than `most` boxes.
  static std::optional<EulerBoxes> around(const std::array<std::vector<std::int32_t>, 3>& jumps,
                                          const std::array<std::int32_t, 3>& dims, std::size_t most);

  [[nodiscard]] std::size_t count() const { return ranges_[0].size() * ranges_[1].size() * ranges_[2].size(); }
  // Whether a change at a layer across z may count.
  [[nodiscard]] bool reach(std::size_t layer) const { return near_[2][layer].begin < near_[2][layer].end; }
  // Adds the change of the Euler characteristic at these layers: of the mesh, or with the other sign of the surface.
  void add(const SampleLayers& layers, std::int32_t change);
  // All boxes; as the likely ones those with a sum other than zero, or all if there are none.
  [[nodiscard]] IndexRanges boxes() const;

 private:
  // The ranges near a layer, from the first one to the one behind the last.
  struct Near {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  std::array<std::vector<LayerRange>, 3> ranges_;  // along each axis; near jumps form one range
  std::array<std::vector<Near>, 3> near_;          // along each axis, of each layer
  std::vector<std::int32_t> sums_;                 // of each box
};

}  // namespace deliso
