// The file formats of mesh_io: each turns a mesh into the bytes of a file and back. `file` is only the name that errors
// give; they are InputErrors of the form "FILE, line N: expected ..., found ...".
#pragma once

#include <string>
#include <string_view>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

std::string ply_bytes(const TriangleMesh& mesh, bool ascii);
std::string off_bytes(const TriangleMesh& mesh);
std::string obj_bytes(const TriangleMesh& mesh);
// Coordinates rounded to floats. Throws InputError, with the name of the file, when one is beyond the range of floats.
std::string stl_bytes(const TriangleMesh& mesh, bool ascii, const std::string& name = "STL file");

TriangleMesh parse_ply(std::string_view bytes, const std::string& file);
TriangleMesh parse_off(std::string_view bytes, const std::string& file);
TriangleMesh parse_obj(std::string_view bytes, const std::string& file);
TriangleMesh parse_stl(std::string_view bytes, const std::string& file);

}  // namespace deliso
