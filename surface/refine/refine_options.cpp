#include "surface/refine/refine_options.h"

#include "surface/base/sizes.h"

namespace deliso {

RefineOptions refine_options(const Parameters& parameters, const Box3& box, std::span<const Vec3> coverage_targets,
                             int threads) {
  const Stage2Parameters& stage2 = parameters.stage2;
  RefineOptions options;
  constexpr double kOff = std::numeric_limits<double>::infinity();
  options.epsilon1 = is_sized(parameters) ? kOff : stage2.epsilon1;
  options.epsilon2 = is_sized(parameters) ? kOff : stage2.epsilon2;
  options.rho = effective_rho(stage2.rho, parameters.size);
  options.r_min = absolute_r_min(stage2.r_min, box);
  options.max_distance = refined_height(parameters);
  options.h_min = effective_h_min(parameters);
  options.smoothing_passes = improves_shape(parameters) && !is_sized(parameters) ? parameters.shape.smoothing : 0;
  options.order = parameters.queue_order;
  options.restart_at_crossings = repairs(parameters);
  options.criterion2 = stage2.criterion2;
  options.new_pole = stage2.new_pole;
  options.store_hits = stage2.store_hits;
  options.keep_neighbours = false;
  options.coverage_targets = coverage_targets;
  options.threads = threads;
  return options;
}

}  // namespace deliso
