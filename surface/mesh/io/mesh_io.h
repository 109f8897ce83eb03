// Triangle meshes in files: PLY (binary little endian or ASCII), OFF, OBJ, STL (binary), chosen by the extension.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// The extensions of mesh files, for messages: ".ply, .off, .obj or .stl".
inline constexpr std::string_view kMeshExtensions = ".ply, .off, .obj or .stl";

// Whether write_mesh and read_mesh know the extension of a file, in small or capital letters.
bool is_mesh_path(const std::filesystem::path& path);

// Whether the format holds coordinates as floats only (STL).
bool keeps_floats(const std::filesystem::path& path);

// Writes whole or not at all (a temporary file beside it, then a rename). Coordinates are doubles (STL: floats).
// Comments are lines that say where the mesh comes from: of PLY, # lines of OFF and OBJ, the name of STL. Throws
// InputError when the extension is unknown or the file cannot be written.
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, bool ascii = false,
                const std::vector<std::string>& comments = {});

// Throws InputError naming file, line or byte, and what was expected. STL corners with equal coordinates become one
// vertex.
TriangleMesh read_mesh(const std::filesystem::path& path);

}  // namespace deliso
