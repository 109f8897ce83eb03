// The comments of mesh files.
#pragma once

#include <string_view>

#include "surface/mesh/io/mesh_file_options.h"

namespace deliso {

// Those of PLY's header (obj_info included), the # lines of OFF, OBJ and Medit, the name of STL's solid or the text in
// its binary header. (Those of VTK and VTP come with the mesh.) Of other programs' files, too; at most 100.
MeshComments comments_of(std::string_view bytes, MeshFormat format);

}  // namespace deliso
