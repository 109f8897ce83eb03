// JSON as the program reads and writes it: strict when reading, without NaN or infinity when writing.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace deliso {

// Keys keep the order they were written in.
using Json = nlohmann::ordered_json;

// Strict JSON: no comments, no trailing text, no duplicate key in an object, no number that overflows a double, at
// most 500 objects and arrays within each other. Throws InputError naming `source` (a file, say) with line and column.
Json parse_json(const std::string& text, const std::string& source);

// Throws InputError also when the file cannot be read.
Json read_json(const std::filesystem::path& path);

// Two-space indentation and a final newline. Numbers that are not finite become null; bytes that are not UTF-8 (in a
// path, say) become the replacement character.
std::string json_text(const Json& document);

// The same on one line, without a newline: for lines of JSON, and JSON within other text.
std::string json_line(const Json& document);

}  // namespace deliso
