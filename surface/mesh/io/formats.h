// The file formats of mesh_io: each turns a mesh into the bytes of a file and back. `file` is only the name that errors
// give; they are InputErrors of the form "FILE, line N: expected ..., found ...".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// Lines that say where a mesh comes from.
using MeshComments = std::vector<std::string>;

std::string ply_bytes(const TriangleMesh& mesh, bool ascii, const MeshComments& comments = {});
std::string off_bytes(const TriangleMesh& mesh, const MeshComments& comments = {});
std::string obj_bytes(const TriangleMesh& mesh, const MeshComments& comments = {});
// Coordinates rounded to floats. Throws InputError, with the name of the file, when one is beyond the range of floats.
// Comments go into the name of the solid, or as far as there is room into the 80 bytes of the binary header.
std::string stl_bytes(const TriangleMesh& mesh, bool ascii, const std::string& name = "STL file",
                      const MeshComments& comments = {});

TriangleMesh parse_ply(std::string_view bytes, const std::string& file);
TriangleMesh parse_off(std::string_view bytes, const std::string& file);
TriangleMesh parse_obj(std::string_view bytes, const std::string& file);
TriangleMesh parse_stl(std::string_view bytes, const std::string& file);

}  // namespace deliso
