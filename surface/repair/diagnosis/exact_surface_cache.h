// Data of an isosurface that repair may need, that do not depend on the mesh and take time to compute.
#pragma once

#include <future>
#include <thread>

#include "surface/base/exact_surface.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/repair/diagnosis/exact_euler_curves.h"

namespace deliso {

// Each item is computed when it is first requested. If there is more than one thread, a thread of its own computes the
// Euler curves in advance, while others build the mesh for which they are needed. The results are the same either way.
class ExactSurfaceCache {
 public:
  // Keeps the references in `surface`.
  explicit ExactSurfaceCache(const ExactSurface& surface);

  [[nodiscard]] const ExactSurface& surface() const { return surface_; }
  [[nodiscard]] const ExactEulerCurves& euler_curves() const { return euler_curves_.get(); }
  // Few surfaces need this, and it is large: so it is never computed in advance.
  [[nodiscard]] const ExactPolygonization& polygonized() const { return polygonized_.get(); }

 private:
  ExactSurface surface_;
  // Deferred: the first caller computes it, other callers wait.
  std::shared_future<ExactEulerCurves> euler_curves_;
  std::shared_future<ExactPolygonization> polygonized_;
  std::jthread finder_;
};

}  // namespace deliso
