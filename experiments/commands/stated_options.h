// Parameters that one command line states more than once: by --set and by the option that stands for the same key.
#pragma once

#include <string>
#include <vector>

#include "experiments/commands/field_options.h"
#include "experiments/commands/size_options.h"
#include "surface/base/parameters.h"
#include "volume/io/base/volume.h"

namespace deliso {

// As typed.
struct StatedOptions {
  const std::vector<std::string>& assignments;  // of --set
  const FieldOptions& field;
  const SizeOptions& sizes;
  bool closed = false;
};

// Throws InputError when two of them state different values of one parameter, and names both. `parameters` has what is
// stated. Without a volume lengths in units of the world are not compared. A --config states nothing: what is typed
// beside it replaces what it says.
void check_agreement(const StatedOptions& stated, const Volume* volume, const Parameters& parameters);

}  // namespace deliso
