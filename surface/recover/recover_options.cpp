#include "surface/recover/recover_options.h"

#include <algorithm>

#include "surface/base/sizes.h"

namespace deliso {

RecoverOptions recover_options(const Parameters& parameters, const Box3& box, int threads) {
  const Stage1Parameters& stage1 = parameters.stage1;
  RecoverOptions options;
  options.threads = threads;
  options.geometry = {.epsilon = stage1.epsilon,
                      .rho = effective_rho(stage1.rho, parameters.size),
                      .r_min = absolute_r_min(stage1.r_min, box)};
  options.size_bound = std::max(options.geometry.r_min, stage1.size_bound_voxels);
  options.order = parameters.queue_order;
  return options;
}

RecoverOptions full3d_options(const Parameters& parameters, const Box3& box) {
  const Stage2Parameters& stage2 = parameters.stage2;
  RecoverOptions options;
  options.geometry = {.epsilon = stage2.epsilon1,
                      .rho = effective_rho(stage2.rho, parameters.size),
                      .r_min = absolute_r_min(stage2.r_min, box),
                      .epsilon2 = stage2.epsilon2,
                      .criterion2 = stage2.criterion2,
                      .h_min = effective_h_min(parameters)};
  options.new_pole = stage2.new_pole;
  if (stage2.max_distance) options.geometry.max_distance = *stage2.max_distance;
  options.size_bound = options.geometry.r_min;
  options.order = parameters.queue_order;
  return options;
}

}  // namespace deliso
