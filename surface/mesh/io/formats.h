// The file formats of mesh_io: each turns a mesh into the bytes of a file and back. `file` is only the name that errors
// give; they are InputErrors of the form "FILE, line N: expected ..., found ...".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/io/mesh_file_options.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

std::string ply_bytes(const TriangleMesh& mesh, bool ascii, const MeshComments& comments = {});
std::string off_bytes(const TriangleMesh& mesh, const MeshComments& comments = {});
std::string obj_bytes(const TriangleMesh& mesh, const MeshComments& comments = {});
// Coordinates rounded to floats (stl_points). Throws InputError, with the name of the file, when one is beyond the
// range of floats. Comments go into the name of the solid, or as far as there is room into the 80 bytes of the binary
// header.
std::string stl_bytes(const TriangleMesh& mesh, bool ascii, const std::string& name = "STL file",
                      const MeshComments& comments = {});
// Medit's .mesh. Reference numbers of vertices and triangles are those of triangle_references.
std::string medit_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {});
// Gmsh's .msh as text: a surface for each component. Its comments hold the script that fills the solids, in lines that
// begin with `geo`; the script names the file `name`.
std::string gmsh_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {},
                       const std::string& name = "mesh.msh");
// TetGen's .smesh: the triangles as facets, a hole point in each cavity, a region point in each solid.
std::string smesh_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {});
// VTK's legacy format and its XML format for PolyData, with all attributes.
std::string legacy_vtk_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {});
std::string vtp_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {});
// Binary glTF 2.0, in metres where the unit is known. Coordinates are floats that count from the middle of the box,
// which the node's translation holds in full (glb_points). Throws InputError when a coordinate is beyond floats or the
// file would be longer than the format's 4 GiB.
std::string glb_bytes(const TriangleMesh& mesh, const MeshFileOptions& options = {},
                      const std::string& name = "GLB file");

TriangleMesh parse_ply(std::string_view bytes, const std::string& file);
TriangleMesh parse_off(std::string_view bytes, const std::string& file);
TriangleMesh parse_obj(std::string_view bytes, const std::string& file);
// Whether these first bytes of a file have a point `v x y z`, and before it only comments and other statements of OBJ.
bool begins_as_obj(std::string_view head);
TriangleMesh parse_stl(std::string_view bytes, const std::string& file);
// Whether a file of `size` bytes that begins so is STL as binary data: its size fits its number of triangles.
bool is_binary_stl(std::string_view head, std::uint64_t size);
// Triangles and quadrilaterals, with their references for labels; what else a .mesh holds is skipped.
TriangleMesh parse_medit(std::string_view bytes, const std::string& file);
// Polygons and triangle strips of PolyData; lines, single vertices and all values but labels are skipped. Texts of the
// field "comments" are appended to `comments`, if given.
TriangleMesh parse_legacy_vtk(std::string_view bytes, const std::string& file, MeshComments* comments = nullptr);
TriangleMesh parse_vtp(std::string_view bytes, const std::string& file, MeshComments* comments = nullptr);

// The points as the format stores them, read back. Distinct points stay distinct in STL as far as the neighbouring
// floats suffice: else a mesh of STL, which knows vertices by their coordinates only, would not be a manifold. Points
// beyond the range of floats become infinite.
std::vector<Vec3> stl_points(const TriangleMesh& mesh);
std::vector<Vec3> glb_points(const TriangleMesh& mesh, std::optional<double> metres);

// A number >= 1 for each triangle: its "label" among the attributes, or else the number of its component.
std::vector<std::int64_t> triangle_references(const TriangleMesh& mesh, const MeshAttributes& attributes);

}  // namespace deliso
