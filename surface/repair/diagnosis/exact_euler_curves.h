// The exact Euler curves of the isosurface (surface/repair/diagnosis/euler_curve.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/euler_curve.h"

namespace deliso {

// Visits the changes of the surface itself, cell by cell: for each component as a part, twice the change of its Euler
// characteristic. All of those at the sample layers across z that are marked in `layers`, and some at those beside
// them.
void for_each_exact_change(const ExactSurface& surface, const std::vector<bool>& layers, const VisitChange& visit);

// The Euler curves of each exact component. They are those of any mesh that lies in the same cells as the surface, such
// as the marching-cubes mesh. Computed cell by cell, and stored only for the layers that a component reaches.
class ExactEulerCurves {
 public:
  explicit ExactEulerCurves(const ExactSurface& surface);

  [[nodiscard]] EulerCurves of(std::uint32_t component) const;

 private:
  struct Layers {
    std::size_t begin = 0;  // index of its first layer in twice_changes_
    std::int32_t first = 0;
    std::int32_t count = 0;
  };
  class Changes;
  void find_layers(const IsosurfaceTopology& topology);

  Dims dims_;
  std::vector<std::array<Layers, 3>> layers_;  // the layers that each component may reach, along each axis
  // Changes of the Euler characteristic when the plane reaches a layer, times two.
  std::vector<std::int32_t> twice_changes_;
};

}  // namespace deliso
