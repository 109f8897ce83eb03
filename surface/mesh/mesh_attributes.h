// Values that a file may hold beside a mesh: of vertices (component, gradient) or of triangles (quality, label).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace deliso {

struct MeshAttribute {
  std::string name;       // letters, digits and underscores
  std::size_t width = 1;  // numbers of each vertex or triangle: 1, or 3 for vectors
  bool is_whole = false;  // all numbers are whole and fit into 32 bits
  std::vector<double> values;
};

struct MeshAttributes {
  std::vector<MeshAttribute> vertices, triangles;
};

}  // namespace deliso
