// Parameters set by key path and value, whoever reads them: files, the command line, programs that call the library.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "surface/base/parameter_table.h"
#include "surface/base/parameters.h"

namespace deliso {

// The field of a key path; null when there is none.
const ParameterField* find_parameter(std::string_view path);
// Whether some parameters have key paths that begin with this name and a dot.
bool is_parameter_group(std::string_view name);

// "a number > 0", "a number >= 1e-6", "an integer >= 1 or null", "true or false", "one of 'open', 'closed'".
std::string allowed_values(const ParameterField& field);

// Throws InputError that begins with `source` (a file, say) and names the known key that was probably meant.
[[noreturn]] void fail_unknown_parameter(std::string_view path, const std::string& source);
// Throws InputError unless the key path names a parameter, and not a group of them.
void check_parameter_path(std::string_view path, const std::string& source);

// The value if it has the field's type and lies in its range; a whole number may be given as a double. A choice is
// returned as a view of the table's text.
std::optional<ParameterValue> converted_value(const ParameterField& field, const ParameterValue& given);

// Sets one parameter. Throws InputError that names the key path, the values allowed and `found`, the value as it was
// written; nothing given: a value of no type that any parameter has.
void assign_parameter(const ParameterField& field, const std::optional<ParameterValue>& given, const std::string& found,
                      const std::string& source, Parameters& parameters);

}  // namespace deliso
