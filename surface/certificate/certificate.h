// The certificate: the mesh compared, component by component, with the exact topology of the isosurface.
#pragma once

#include <string>
#include <vector>

#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/topology/exact_topology.h"

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
  std::vector<std::string> broken;        // what a proven mesh would have to keep and this one does not (promise.h)
};

// Whether nothing is wrong.
inline bool is_proven(const Certificate& certificate) {
  return certificate.verdict == Verdict::kHomeomorphic && certificate.broken.empty();
}

// The components of a mesh with their topology; sorted. Vertices without a triangle belong to none. Preconditions: the
// mesh is manifold, its indices are in range.
std::vector<ComponentTopology> component_topologies(const TriangleMesh& mesh);

// kHomeomorphic when the mesh is an oriented manifold and its components match the isosurface's one to one: orientable
// surfaces with equal Euler characteristics and equal numbers of boundary loops are homeomorphic. Otherwise kDifferent,
// and `differences` says why. If the mesh is no manifold, its counts are V - E + F all the same. If an index is out of
// range, the counts are left empty. The same for any number of threads.
Certificate certify(const TriangleMesh& mesh, const std::vector<ComponentTopology>& isosurface, int threads = 1);

// The same for a mesh whose indices are in range, of which this is the topology.
Certificate certify(const MeshTopology& mesh, const IsosurfaceTopology& isosurface);

// The same; kSingularIsovalue when the isosurface has singular points (IsosurfaceTopology::singular_cells).
Certificate certify(const TriangleMesh& mesh, const IsosurfaceTopology& isosurface, int threads = 1);

}  // namespace deliso
