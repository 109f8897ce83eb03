#include "surface/verification/dropped_components.h"

#include <cstddef>

#include "delaunay/base/counted.h"
#include "surface/certificate/kept_components.h"

namespace deliso {

std::vector<std::uint8_t> components_left_out(const TriangleMesh& mesh, const ScalarGrid& grid,
                                              const RegularTopology& truth, const Promise& promise) {
  if (promise.dropped_components == 0) return {};
  const AssignmentFaults faults =
      assignment_faults(mesh, mesh_topology(mesh), grid, truth.isovalue, truth.topology, {});
  if (static_cast<std::int64_t>(faults.without.size()) != promise.dropped_components) return {};
  std::vector<std::uint8_t> is_dropped(truth.topology.components.size(), 0);
  for (const std::uint32_t c : faults.without) is_dropped[c] = 1;
  return is_dropped;
}

void refuse_dropped(std::int64_t count, Certificate& certificate) {
  if (certificate.verdict == Verdict::kHomeomorphic) certificate.verdict = Verdict::kDifferent;
  certificate.differences.insert(certificate.differences.begin(),
                                 counted(count, "component was", "components were") +
                                     " to be left out, but another number has no piece of the mesh.");
}

Certificate certify_kept(const TriangleMesh& mesh, const IsosurfaceTopology& truth,
                         std::span<const std::uint8_t> is_dropped) {
  if (is_dropped.empty()) return certify(mesh, truth);
  IsosurfaceTopology kept;
  kept.components = truth.components;
  kept.singular_cells = truth.singular_cells;
  keep_components(kept, is_dropped);
  return certify(mesh, kept);
}

std::vector<Vec3> kept_crossings(const IsosurfaceProbe& probe, const IsosurfaceTopology& truth,
                                 std::span<const std::uint8_t> is_dropped) {
  std::vector<Vec3> all = probe.crossing_points();
  if (is_dropped.empty()) return all;
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_dropped[truth.crossings[i].component] == 0) kept.push_back(all[i]);
  }
  return kept;
}

}  // namespace deliso
