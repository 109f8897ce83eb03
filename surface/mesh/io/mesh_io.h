// Triangle meshes in files, in the formats of mesh_file_options.h: chosen by the extension, or by the content where
// that is unknown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/io/mesh_file_options.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// The extensions of mesh files that are written, for messages, and of those that are read.
inline constexpr std::string_view kMeshExtensions = ".ply, .off, .obj, .stl, .mesh, .msh, .smesh, .vtk, .vtp or .glb";
inline constexpr std::string_view kReadMeshExtensions = ".ply, .off, .obj, .stl, .mesh, .vtk or .vtp";

// The format of the name: "ply", "vtp", ..., in small or capital letters.
std::optional<MeshFormat> mesh_format_named(std::string_view name);
// By the extension of a file.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);
// By the first bytes of a file of `size` bytes; OBJ, which has no mark, by its first point.
std::optional<MeshFormat> mesh_format_of_content(std::string_view head, std::uint64_t size);
// Whether parse_mesh reads the format.
bool is_read(MeshFormat format);

// Whether write_mesh knows the extension of a file, in small or capital letters.
bool is_mesh_path(const std::filesystem::path& path);
// Whether the name is that of a mesh packed by gzip, which is not read; .vtk.gz may be a volume.
bool is_packed_mesh_path(const std::filesystem::path& path);

// Whether a file begins as a mesh of VTK's does: .vtk is an extension of volumes, too.
bool is_mesh_content(const std::filesystem::path& path);

// Whether the format holds coordinates as floats only (STL, GLB).
bool keeps_floats(MeshFormat format);

// The mesh as a file of the format gives it back: in STL and GLB its points are rounded.
TriangleMesh as_stored(TriangleMesh mesh, MeshFormat format, std::optional<double> metres = std::nullopt);

// The bytes of a file. `name` is what errors call it.
std::string mesh_bytes(const TriangleMesh& mesh, MeshFormat format, const MeshFileOptions& options,
                       const std::string& name);

// Writes whole or not at all (a temporary file beside it, then a rename). Coordinates are doubles, but for STL and GLB.
// Comments are lines that say where the mesh comes from: of PLY, # lines of OFF, OBJ, Medit and TetGen, the name of
// STL, a field of VTK and VTP, $Comments of Gmsh, extras of GLB. Throws InputError when the extension is unknown or the
// file cannot be written.
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, bool ascii = false,
                const std::vector<std::string>& comments = {});

// What a file holds, with the comments that its format has a place for.
struct MeshFile {
  TriangleMesh mesh;
  MeshFormat format = MeshFormat::kPly;
  MeshComments comments;
};

// Throws InputError naming file, line or byte, and what was expected. STL corners with equal coordinates become one
// vertex.
MeshFile parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name);
MeshFile read_mesh_file(const std::filesystem::path& path, std::optional<MeshFormat> format = std::nullopt);
TriangleMesh read_mesh(const std::filesystem::path& path);

// "PLY", "STL", "Medit", ...
std::string_view name_of(MeshFormat format);

}  // namespace deliso
