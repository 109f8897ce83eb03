// Where only one component of the isosurface passes: for points that lie on the isosurface this tells which, without a
// look at the cells. Nearly all points of a mesh are in such places.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

class ComponentBlocks {
 public:
  ComponentBlocks(const Dims& dims, const IsosurfaceTopology& topology);

  // The component of a point in index space, within the box, whose block has only one; component_of() finds this one or
  // none. Nothing where there are several.
  [[nodiscard]] std::optional<std::uint32_t> only_component(const Vec3& point) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu, kSeveral = 0xFFFFFFFEu;

  void add(const CellIndex& sample, std::uint32_t component);
  [[nodiscard]] std::size_t place(const CellIndex& block) const {
    return (static_cast<std::size_t>(block[2]) * static_cast<std::size_t>(blocks_[1]) +
            static_cast<std::size_t>(block[1])) *
               static_cast<std::size_t>(blocks_[0]) +
           static_cast<std::size_t>(block[0]);
  }

  Dims dims_;
  Dims blocks_{};                         // how many there are along each axis
  std::vector<std::uint32_t> component_;  // of each block
};

}  // namespace deliso
