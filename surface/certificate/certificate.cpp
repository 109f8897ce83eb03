#include "surface/certificate/certificate.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/counted.h"
#include "surface/mesh/mesh_topology.h"

namespace deliso {

namespace {

// Equal entries of a sorted list.
std::vector<TopologyCount> counts_of(const std::vector<ComponentTopology>& sorted) {
  std::vector<TopologyCount> counts;
  for (const ComponentTopology& topology : sorted) {
    if (counts.empty() || counts.back().topology != topology) counts.push_back({topology, 0});
    ++counts.back().count;
  }
  return counts;
}

std::vector<ComponentTopology> sorted_components(const MeshTopology& topology) {
  std::vector<ComponentTopology> components;
  components.reserve(topology.components.size());
  for (const MeshComponent& component : topology.components) {
    components.push_back({component.euler_characteristic(), component.boundary_loops});
  }
  std::sort(components.begin(), components.end());
  return components;
}

// What keeps the mesh from being an oriented manifold.
void add_defects(const MeshTopology& topology, std::vector<std::string>& differences) {
  if (topology.repeated_vertices > 0) {
    differences.push_back(counted(topology.repeated_vertices, "triangle names", "triangles name") +
                          " the same vertex twice.");
  }
  if (topology.non_manifold_edges > 0) {
    differences.push_back(counted(topology.non_manifold_edges, "edge has", "edges have") + " more than two triangles.");
  }
  if (topology.non_manifold_vertices > 0) {
    differences.push_back(counted(topology.non_manifold_vertices, "vertex has", "vertices have") +
                          " more than one umbrella.");
  }
  if (topology.misoriented_edges > 0) {
    differences.push_back("The two triangles of " + counted(topology.misoriented_edges, "edge", "edges") +
                          " disagree in orientation.");
  }
}

std::string difference(const ComponentTopology& topology, std::int64_t in_mesh, std::int64_t in_isosurface) {
  return "The mesh has " + counted(in_mesh, "component", "components") + " with Euler characteristic " +
         std::to_string(topology.euler_characteristic) + " and " +
         counted(topology.boundary_loops, "boundary loop", "boundary loops") + ", the isosurface has " +
         std::to_string(in_isosurface) + ".";
}

// The two lists merged: one sentence for every kind of component whose counts differ.
void add_count_differences(const std::vector<TopologyCount>& mesh, const std::vector<TopologyCount>& isosurface,
                           std::vector<std::string>& differences) {
  auto m = mesh.begin();
  auto i = isosurface.begin();
  while (m != mesh.end() || i != isosurface.end()) {
    const bool has_mesh = m != mesh.end() && (i == isosurface.end() || m->topology <= i->topology);
    const bool has_isosurface = i != isosurface.end() && (m == mesh.end() || i->topology <= m->topology);
    const ComponentTopology& topology = has_mesh ? m->topology : i->topology;
    const std::int64_t in_mesh = has_mesh ? (m++)->count : 0;
    const std::int64_t in_isosurface = has_isosurface ? (i++)->count : 0;
    if (in_mesh != in_isosurface) differences.push_back(difference(topology, in_mesh, in_isosurface));
  }
}

std::vector<TopologyCount> counts_of_any_order(std::vector<ComponentTopology> components) {
  std::sort(components.begin(), components.end());
  return counts_of(components);
}

Certificate compared(const MeshTopology& mesh, const std::vector<ComponentTopology>& isosurface) {
  Certificate certificate;
  certificate.verdict = Verdict::kDifferent;
  certificate.isosurface = counts_of_any_order(isosurface);
  certificate.manifold = mesh.is_manifold();
  certificate.oriented = mesh.is_oriented();
  certificate.mesh = counts_of(sorted_components(mesh));
  add_defects(mesh, certificate.differences);
  add_count_differences(certificate.mesh, certificate.isosurface, certificate.differences);
  if (certificate.differences.empty()) certificate.verdict = Verdict::kHomeomorphic;
  return certificate;
}

void add_singular_cells(const IsosurfaceTopology& isosurface, Certificate& certificate) {
  if (isosurface.singular_cells.empty()) return;
  const CellIndex& cell = isosurface.singular_cells.front();
  certificate.verdict = Verdict::kSingularIsovalue;
  certificate.differences.insert(
      certificate.differences.begin(),
      "The isovalue is that of a saddle: the isosurface is no manifold in " +
          counted(static_cast<std::int64_t>(isosurface.singular_cells.size()), "cell", "cells") + ", the first one (" +
          std::to_string(cell[0]) + ", " + std::to_string(cell[1]) + ", " + std::to_string(cell[2]) + ").");
}

}  // namespace

std::vector<ComponentTopology> component_topologies(const TriangleMesh& mesh) {
  return sorted_components(mesh_topology(mesh));
}

Certificate certify(const TriangleMesh& mesh, const std::vector<ComponentTopology>& isosurface, int threads) {
  const std::size_t bad = first_bad_triangle(mesh);
  if (bad == mesh.triangles.size()) return compared(mesh_topology(mesh, threads), isosurface);
  Certificate certificate;
  certificate.verdict = Verdict::kDifferent;
  certificate.isosurface = counts_of_any_order(isosurface);
  certificate.differences.push_back("Triangle " + std::to_string(bad) + " names a vertex beyond the mesh's " +
                                    counted(static_cast<std::int64_t>(mesh.points.size()), "point.", "points."));
  return certificate;
}

Certificate certify(const MeshTopology& mesh, const IsosurfaceTopology& isosurface) {
  Certificate certificate = compared(mesh, isosurface.components);
  add_singular_cells(isosurface, certificate);
  return certificate;
}

Certificate certify(const TriangleMesh& mesh, const IsosurfaceTopology& isosurface, int threads) {
  Certificate certificate = certify(mesh, isosurface.components, threads);
  add_singular_cells(isosurface, certificate);
  return certificate;
}

}  // namespace deliso
