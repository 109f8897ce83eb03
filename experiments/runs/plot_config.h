// The plots of an experiment as JSON.
#pragma once

#include <vector>

#include "experiments/config/strict_object.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// The plots that an experiment names. The other members of `experiment` must be set already. Throws InputError like
// parse_experiment, also when a plot of one kind has a key of another.
std::vector<Plot> parse_plots(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes);

// For parse_plots to read back.
Json plots_to_json(const std::vector<Plot>& plots);

}  // namespace deliso
