// What repair may want to know of an isosurface whatever the mesh: facts that take time to find.
#pragma once

#include <future>
#include <thread>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/exact_euler_curves.h"
#include "surface/repair/diagnosis/exact_polygonization.h"

namespace deliso {

// Each fact is found when it is first asked for; with more than one thread a thread of its own finds the sweeps
// beforehand, while others build the mesh that they are for. The facts are the same either way.
class ExactSurfaceCache {
 public:
  // Keeps what `surface` refers to.
  explicit ExactSurfaceCache(const ExactSurface& surface);

  [[nodiscard]] const ExactSurface& surface() const { return surface_; }
  [[nodiscard]] const ExactEulerCurves& sweeps() const { return sweeps_.get(); }
  // Needed by few surfaces, and large: never found beforehand.
  [[nodiscard]] const ExactPolygonization& polygonized() const { return polygonized_.get(); }

 private:
  ExactSurface surface_;
  // Deferred: whoever asks first does the work, anyone else waits for it.
  std::shared_future<ExactEulerCurves> sweeps_;
  std::shared_future<ExactPolygonization> polygonized_;
  std::jthread finder_;
};

}  // namespace deliso
