// The metrics of an experiment as JSON: columns of its table.
#pragma once

#include <vector>

#include "experiments/config/strict_object.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// The other members of `experiment` that a metric names, variants and reference, must be set already.
std::vector<Metric> parse_metrics(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes);

// For parse_metrics to read back.
Json metrics_to_json(const std::vector<Metric>& metrics);

}  // namespace deliso
