// What `deliso verify` has found, as JSON and as a table.
#pragma once

#include <ostream>

#include "experiments/config/json.h"
#include "surface/verification/verification.h"

namespace deliso {

// Every check by its name, with "pass" and its figures.
Json checks_json(const Verification& v);

// A report's "checks" and "quality", one row a figure; lists are left out.
void print_checks(const Json& report, std::ostream& stream);

}  // namespace deliso
