// The certificate: the mesh compared, component by component, with the exact topology of the isosurface.
#pragma once

#include <string>
#include <vector>

#include "surface/triangle_mesh.h"
#include "volume/exact_topology.h"

namespace deliso {

enum class Verdict { kHomeomorphic, kDifferent, kSingularIsovalue, kNotChecked };

struct TopologyCount {
  ComponentTopology topology;
  std::int64_t count = 0;
};

struct Certificate {
  Verdict verdict = Verdict::kNotChecked;
  bool manifold = false;                  // every edge has one or two triangles, every vertex one umbrella
  bool oriented = false;                  // neighbours agree in orientation
  std::vector<TopologyCount> mesh;        // sorted by (euler_characteristic, boundary_loops)
  std::vector<TopologyCount> isosurface;  // the same for the exact topology
  std::vector<std::string> differences;   // one sentence each
};

// The components of a mesh with their topology; sorted. Precondition: the mesh is manifold.
std::vector<ComponentTopology> component_topologies(const TriangleMesh& mesh);

Certificate certify(const TriangleMesh& mesh, const std::vector<ComponentTopology>& isosurface);

}  // namespace deliso
