// The options of `deliso mesh` that state sizes and what is kept. Each is a parameter, too: they are set after --set.
#pragma once

#include <string>
#include <vector>

#include "experiments/commands/command.h"
#include "experiments/commands/world.h"
#include "surface/deliso.h"
#include "volume/io/base/volume.h"

namespace deliso {

// As typed; empty: not given.
struct SizeOptions {
  std::string max_error, max_edge, min_angle, max_aspect, target_vertices;
  std::string keep_largest, min_component, region;
  bool fill_cavities = false;
};

void add_size_options(Command& command, SizeOptions& options);

// Sets what was given. Throws InputError naming the option. Without a volume only the form of lengths is checked.
void apply_size_options(const SizeOptions& options, const Volume* volume, Parameters& parameters);

// What a mesh file says of components and samples left out and of a spacing that was ignored (mesh_notes.h).
struct KeptInFile {
  std::int64_t dropped = 0;
  std::string region;  // empty: all samples
  bool ignores_spacing = false;
};
KeptInFile kept_in_file(const std::vector<std::string>& comments);

// What stderr tells of sizes that were asked for: components left out, a number not reached.
std::vector<std::string> size_remarks(const Parameters& parameters, const MeshingResult& result);

}  // namespace deliso
