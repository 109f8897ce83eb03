#include "surface/parameters.h"

#include "delaunay/base/check.h"

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

}  // namespace deliso
