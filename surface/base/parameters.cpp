#include "surface/base/parameters.h"

#include <algorithm>
#include <string>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

void check_parameters(const Parameters& parameters) {
  if (parameters.stage2.pole_height != PoleHeight::kNearer && repairs(parameters)) {
    throw InputError("stage2.pole_height: repair takes the nearer pole; another one needs repair.max_rounds = 0");
  }
  const bool is_sized = parameters.size.max_error || parameters.size.target_vertices;
  if (is_sized && (!repairs(parameters) || parameters.algorithm != Algorithm::kTwoStage)) {
    throw InputError(std::string(parameters.size.max_error ? "size.max_error" : "size.target_vertices") +
                     ": expected algorithm = two_stage, certify = true and repair.max_rounds above 0, without which no "
                     "distance is kept");
  }
  if (drops_components(parameters.components) && !parameters.certify) {
    throw InputError("components: what is left out is known from the exact topology; it needs certify = true");
  }
  if (!parameters.stage1.one_sign_per_tetrahedron &&
      (repairs(parameters) || parameters.stage1.coverage || !parameters.certify)) {
    throw InputError(
        "stage1.one_sign_per_tetrahedron: false gives facets that only the certificate can judge; it needs certify = "
        "true, stage1.coverage = false and repair.max_rounds = 0");
  }
}

SampleRegion region_of(const RegionParameters& region) {
  return {{region.i0, region.j0, region.k0}, {region.i1, region.j1, region.k1}};
}

bool drops_components(const ComponentParameters& components) {
  return components.fill_cavities || components.min_vertices || components.min_area || components.min_volume ||
         components.keep_largest;
}

Vec3 spacing_to_use(const Parameters& parameters, const Vec3& of_volume) {
  if (parameters.spacing == SpacingUse::kIgnore) return {1, 1, 1};
  constexpr double kMostTimes = 1000;
  const auto [smallest, largest] = std::minmax({of_volume.x, of_volume.y, of_volume.z});
  if (largest <= kMostTimes * smallest) return of_volume;
  throw InputError(
      "the volume's spacing is " + shortest_text(of_volume.x) + " " + shortest_text(of_volume.y) + " " +
      shortest_text(of_volume.z) + ", the largest more than " + shortest_text(kMostTimes) +
      " times the smallest: expected spacings nearer to each other, or the parameter spacing = \"ignore\"");
}

}  // namespace deliso
