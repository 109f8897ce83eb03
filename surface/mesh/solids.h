// The parts of space that the closed components of a mesh bound: solids and cavities, one in the other, with a point
// inside each. Programs that fill surfaces with tetrahedra ask for such points.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// What lies within a closed component and within no component inside it.
struct EnclosedPart {
  std::uint32_t component = 0;          // of MeshTopology, that bounds the part from outside
  bool is_solid = true;                 // the component's normals point out of the part: else it is a cavity
  std::optional<std::uint32_t> parent;  // the part around the component (an index of `parts`); none: the outside
  // Strictly within the part: proven by counting, with exact predicates, how often every component winds around it.
  // None where none was found, as in a mesh that crosses itself.
  std::optional<Vec3> point;
};

struct EnclosedParts {
  std::vector<EnclosedPart> parts;   // one for each closed component, in the order of components
  std::int64_t open_components = 0;  // with a boundary: they enclose nothing
};

// Precondition: indices in range. In a mesh that is not manifold and oriented every component counts as open.
EnclosedParts enclosed_parts(const TriangleMesh& mesh, const MeshTopology& topology);

}  // namespace deliso
