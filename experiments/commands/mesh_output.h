// Meshes as the command line names them: files by their extensions, and `-` for standard output and input.
#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "experiments/commands/command.h"
#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/io/stl_notes.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// As typed.
struct MeshFormatOptions {
  std::string format;  // empty: by the extension; of standard output: PLY
  std::string gmsh_version = "4.1";
};

// `--format` and, for a mesh that is written, `--msh-version`.
void add_mesh_output_options(Command& command, MeshFormatOptions& options);
void add_mesh_input_option(Command& command, MeshFormatOptions& options);

// The format of an output. Throws InputError naming the option when there is none, or the version of Gmsh is unknown.
MeshFormat output_format(const std::string& path, const std::string& option, const MeshFormatOptions& options);
// Throws InputError unless the output can be written.
void check_mesh_output(const std::string& path, const std::string& option, const MeshFormatOptions& options);
// Precondition: checked.
GmshVersion gmsh_version(const MeshFormatOptions& options);

// To the file, or to standard output where the path is `-`; the comments of binary STL in their short form. Returns the
// options that `verify` will need because the file has no room to say the same; mostly none.
std::string write_mesh_output(const TriangleMesh& mesh, const std::string& path, MeshFileOptions options);

// From the file, or from standard input where the path is `-`. The comments of binary STL are in their long form again.
MeshFile read_mesh_input(const std::string& path, const MeshFormatOptions& options);

// area, enclosed_volume (null where the mesh has a boundary), box; `components`: the same of
// each with its vertices, triangles, Euler characteristic and boundary loops. In the coordinates of the mesh's file.
Json surface_json(const TriangleMesh& mesh, int threads);

}  // namespace deliso
