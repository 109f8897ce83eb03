// How a mesh is written, and what goes into the file beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/mesh_attributes.h"

namespace deliso {

// The formats of meshes. The last three of the list are written only.
enum class MeshFormat { kPly, kOff, kObj, kStl, kMedit, kLegacyVtk, kVtp, kGmsh, kSmesh, kGlb };

// Lines that say where a mesh comes from.
using MeshComments = std::vector<std::string>;

// The header of a binary STL file. Those comments are in it, joined by "; ", for which there is room as a whole.
constexpr std::size_t kStlHeaderLetters = 80;

enum class GmshVersion { k2, k4 };  // 2.2, 4.1

struct MeshFileOptions {
  std::optional<MeshFormat> format;  // none: by the extension
  bool ascii = false;                // text where a format has both (PLY, STL, VTK, VTP)
  MeshComments comments;
  MeshAttributes attributes;  // VTK and VTP hold all; Medit, Gmsh 2.2 and TetGen the triangles' "label"
  GmshVersion gmsh_version = GmshVersion::k4;
  std::optional<double> metres;  // in a unit of the coordinates, where it is known: GLB is in metres
};

}  // namespace deliso
