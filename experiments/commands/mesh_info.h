// deliso info of a mesh: counts, topology, area, enclosed volume, box, angles, comments.
#pragma once

#include <string>

#include "experiments/commands/mesh_output.h"
#include "experiments/system/exit_code.h"

namespace deliso {

// Whether `deliso info` is asked about a mesh: by --format, by the extension, or (.vtk, unknown ones and standard
// input) by the content.
bool is_mesh_input(const std::string& path, const MeshFormatOptions& format);

// Precondition: the report, if any, can be written.
ExitCode run_mesh_info(const std::string& path, const MeshFormatOptions& format, const std::string& report, bool json);

}  // namespace deliso
