// A mesh, the exact component of each of its vertices, and what each of its pieces was matched with.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/certificate/component_match.h"
#include "surface/extract/build_triangle_mesh.h"

namespace deliso {

// A mesh of the whole surface and what it was matched with.
struct MatchedMesh {
  BuiltMesh built;
  std::vector<std::uint32_t> component;  // of each mesh vertex: the exact component it lies on
  ComponentMatch match;
};

}  // namespace deliso
