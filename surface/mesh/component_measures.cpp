#include "surface/mesh/component_measures.h"

#include <cstddef>

namespace deliso {

std::vector<ComponentMeasure> component_measures(const TriangleMesh& mesh, const MeshTopology& topology) {
  const std::size_t count = topology.components.size();
  std::vector<ComponentMeasure> measures(count);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::uint32_t component = topology.component_of_vertex[v];
    if (component != MeshTopology::kNoComponent) measures[component].box.extend(mesh.points[v]);
  }
  // Volumes are summed from a point of the component: far from the origin digits would cancel.
  std::vector<double> volumes(count);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t component = topology.component_of_vertex[a];
    ComponentMeasure& measure = measures[component];
    const Vec3 normal = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    measure.area += 0.5 * norm_of_any_size(normal);
    volumes[component] += dot(mesh.points[a] - measure.box.low, normal) / 6;
  }
  if (!topology.is_oriented()) return measures;
  for (std::size_t i = 0; i < count; ++i) {
    if (topology.components[i].boundary_loops == 0) measures[i].enclosed_volume = volumes[i];
  }
  return measures;
}

ComponentMeasure whole_measure(const std::vector<ComponentMeasure>& measures) {
  ComponentMeasure whole;
  if (!measures.empty()) whole.enclosed_volume = 0;
  for (const ComponentMeasure& measure : measures) {
    whole.area += measure.area;
    whole.box.extend(measure.box.low);
    whole.box.extend(measure.box.high);
    if (!measure.enclosed_volume) whole.enclosed_volume.reset();
    if (whole.enclosed_volume) *whole.enclosed_volume += *measure.enclosed_volume;
  }
  return whole;
}

}  // namespace deliso
