// Parsing and checks of option values.
#pragma once

#include <cstdint>
#include <string>

namespace deliso {

// A finite decimal number. Throws InputError naming the option.
double parse_number(const std::string& text, const std::string& option);
// The same of a part of what was typed, all of which the message quotes, as what was expected.
double parse_number(const std::string& text, const std::string& option, const std::string& typed,
                    const std::string& expected = "a finite number");

// A whole number from `low` to `high`. Throws InputError naming the option and the range.
std::uint64_t parse_count(const std::string& text, const std::string& option, std::uint64_t low, std::uint64_t high);

// A number of threads, or "auto": as many as the machine has. Throws InputError naming --threads.
std::int32_t parse_threads(const std::string& text);

// For CommandOption::check of an option that names a file or folder: an error text when the name is empty, else
// nothing. An empty name would be treated like a missing option.
std::string refuse_empty_name(const std::string& name);

// The same for an option that takes a value.
std::string refuse_empty_value(const std::string& value);

}  // namespace deliso
