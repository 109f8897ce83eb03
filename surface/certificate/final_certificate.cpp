#include "surface/certificate/final_certificate.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "delaunay/base/counted.h"
#include "surface/intersection/self_intersection.h"

namespace deliso {

Certificate final_certificate(const MeshTopology& mesh, const IsosurfaceTopology& topology,
                              const AssignmentFaults& faults, bool bounds_a_solid) {
  Certificate certificate = certify(mesh, topology);
  add_assignment_faults(faults, certificate);
  if (bounds_a_solid) return certificate;
  if (certificate.verdict == Verdict::kHomeomorphic) certificate.verdict = Verdict::kDifferent;
  certificate.differences.insert(
      certificate.differences.begin(),
      "The restricted facets bound no set of tetrahedra: they are given as they are, without stage 2.");
  return certificate;
}

bool is_exact_in_world(const Isosurface& isosurface) {
  const ScalarGrid& grid = isosurface.grid();
  bool is_exact = grid.origin() == Vec3() && !grid.walls();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    is_exact = is_exact && std::frexp(grid.spacing()[axis] / isosurface.step()[axis], &exponent) == 0.5;
  }
  return is_exact;
}

}  // namespace deliso
