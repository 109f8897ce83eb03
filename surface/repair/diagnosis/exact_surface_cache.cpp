#include "surface/repair/diagnosis/exact_surface_cache.h"

#include <exception>
#include <stop_token>

namespace deliso {

ExactSurfaceCache::ExactSurfaceCache(const ExactSurface& surface)
    : surface_(surface),
      euler_curves_(std::async(std::launch::deferred, [surface] { return ExactEulerCurves(surface); })),
      polygonized_(std::async(std::launch::deferred, [surface] { return exact_polygonization(surface); })) {
  if (surface.threads < 2) return;
  try {
    // The thread has futures of its own; an exception is rethrown to those who request the result.
    finder_ = std::jthread([curves = euler_curves_](const std::stop_token& stop) {
      if (!stop.stop_requested()) curves.wait();  // otherwise nothing will be requested any more
    });
  } catch (const std::exception&) {
    // No thread can be created: the data are computed when requested.
  }
}

}  // namespace deliso
