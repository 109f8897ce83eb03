// Area, enclosed volume and box of every component of a mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

struct ComponentMeasure {
  double area = 0;
  // Of what the component encloses, by the divergence theorem: positive when its normals point outwards, negative for
  // the wall of a cavity. None where it has a boundary, or the mesh is not manifold and oriented.
  std::optional<double> enclosed_volume;
  Box3 box;
};

// In the order of topology.components. Sums are in the order of triangles.
std::vector<ComponentMeasure> component_measures(const TriangleMesh& mesh, const MeshTopology& topology);

// The same of the whole: the volume is that of the solids without their cavities, none unless all components have one.
ComponentMeasure whole_measure(const std::vector<ComponentMeasure>& measures);

}  // namespace deliso
