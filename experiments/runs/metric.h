// The values that table columns take from records.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// The value that a record holds at a path of keys with dots; null when there is none.
Json value_at(const Json& record, const std::string& path);

// Every path at which the records of such an experiment hold a number, a text, a truth value or a list of numbers.
const std::vector<std::string>& record_paths(Task task, bool distances);

// Whether they hold a text, a truth value or a list at this path: nothing to divide or to draw.
bool is_no_number(const Experiment& experiment, const std::string& path);

}  // namespace deliso
