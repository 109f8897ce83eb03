// The pieces of a mesh matched with the exact components of the isosurface, by position and by topology.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/surface_mesh.h"
#include "volume/exact_topology.h"

namespace deliso {

// A connected piece of a mesh.
struct MeshPiece {
  ComponentTopology topology;
  std::uint32_t component = 0;  // the exact component of its first vertex
  bool mixed = false;           // it has vertices of several exact components
  bool matched = false;
};

struct ComponentMatch {
  std::vector<MeshPiece> pieces;
  std::vector<std::uint32_t> piece_of;    // of each mesh vertex
  std::vector<bool> component_matched;    // of each exact component
  std::int64_t unmatched_components = 0;  // exact components without their one piece of the same topology
  std::int64_t unmatched_pieces = 0;
  std::int64_t characteristic_error = 0;  // sum over unmatched components of |chi of all their pieces - exact chi|
  [[nodiscard]] bool complete() const { return unmatched_components == 0 && unmatched_pieces == 0; }
  // The smaller the better.
  [[nodiscard]] std::int64_t error() const { return unmatched_components + unmatched_pieces + characteristic_error; }
};

// A component is matched when exactly one piece has vertices on it, that piece has no others, and (Euler
// characteristic, boundary loops) agree. `component_of`: the exact component of each mesh vertex.
ComponentMatch match_components(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                const std::vector<ComponentTopology>& components);

}  // namespace deliso
