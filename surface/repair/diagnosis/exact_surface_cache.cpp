#include "surface/repair/diagnosis/exact_surface_cache.h"

#include <exception>
#include <stop_token>

namespace deliso {

ExactSurfaceCache::ExactSurfaceCache(const ExactSurface& surface)
    : surface_(surface),
      sweeps_(std::async(std::launch::deferred, [surface] { return ExactEulerCurves(surface); })),
      polygonized_(std::async(std::launch::deferred, [surface] { return exact_polygonization(surface); })) {
  if (surface.threads < 2) return;
  try {
    // Through futures of its own; what a search throws is thrown to those who ask.
    finder_ = std::jthread([sweeps = sweeps_](const std::stop_token& stop) {
      if (!stop.stop_requested()) sweeps.wait();  // else nobody will ask any more
    });
  } catch (const std::exception&) {
    // No thread to be had: facts are found when they are asked for.
  }
}

}  // namespace deliso
