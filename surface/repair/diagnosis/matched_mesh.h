// A mesh, the exact component of each of its vertices, and the match of its pieces with the exact components.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/certificate/component_match.h"
#include "surface/extract/build_triangle_mesh.h"

namespace deliso {

// A mesh of the whole surface and its match.
struct MatchedMesh {
  BuiltMesh built;
  std::vector<std::uint32_t> component;  // of each mesh vertex: its exact component
  ComponentMatch match;
};

}  // namespace deliso
