// What `deliso mesh` tells of a mesh: a table, and remarks.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "experiments/commands/field_options.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"

namespace deliso {

// One surface: all of a run but for several labels.
struct Meshed {
  std::optional<std::int32_t> label;
  ChosenField chosen;
  MeshingOptions meshing;
  MeshingResult result;
  MeshQuality quality;
};

void print_summary(const Meshed& meshed, std::ostream& stream);
// On stderr, what a reader must know beyond the table.
void print_remarks(const Meshed& meshed);

}  // namespace deliso
