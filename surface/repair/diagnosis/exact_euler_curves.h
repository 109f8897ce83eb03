// What lies of the isosurface below a plane that sweeps along an axis: the exact side of
// surface/repair/diagnosis/euler_curve.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/euler_curve.h"

namespace deliso {

// The swept characteristics of each exact component: those that a mesh has that keeps to the cells as the surface does,
// such as its marching-cubes mesh. Found cell by cell, and kept for the layers only that a component reaches.
class ExactEulerCurves {
 public:
  explicit ExactEulerCurves(const ExactSurface& surface);

  [[nodiscard]] EulerCurves of(std::uint32_t component) const;

 private:
  struct Layers {
    std::size_t begin = 0;  // in twice_changes_
    std::int32_t first = 0;
    std::int32_t count = 0;
  };
  class Changes;
  void find_layers(const IsosurfaceTopology& topology);

  Dims dims_;
  std::vector<std::array<Layers, 3>> layers_;  // that each component may reach, along each axis
  std::vector<std::int32_t> twice_changes_;    // of the Euler characteristic, when the plane comes to a layer
};

}  // namespace deliso
