#include "surface/base/parameters.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

void check_parameters(const Parameters& parameters) {
  if (parameters.stage2.pole_height != PoleHeight::kNearer && repairs(parameters)) {
    throw InputError("stage2.pole_height: repair takes the nearer pole; another one needs repair.max_rounds = 0");
  }
  if (!parameters.stage1.one_sign_per_tetrahedron &&
      (repairs(parameters) || parameters.stage1.coverage || !parameters.certify)) {
    throw InputError(
        "stage1.one_sign_per_tetrahedron: false gives facets that only the certificate can judge; it needs certify = "
        "true, stage1.coverage = false and repair.max_rounds = 0");
  }
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
