// What a mesh's file says of itself for `verify`, the program's and the library's: lines of a key and a value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "surface/deliso.h"

namespace deliso {

inline constexpr std::string_view kPromiseNote = "promise.max_distance", kDroppedNote = "components dropped",
                                  kRegionNote = "region", kSpacingNote = "spacing", kLabelNote = "field.label",
                                  kSmoothNote = "field.smooth", kInvertNote = "field.invert",
                                  kBoundaryNote = "boundary";

std::string note_line(std::string_view key, std::string_view value);
// With a question mark for each line end and the like: a note is a line of its file.
std::string on_one_line(std::string text);

// The distance promised, components and samples left out, and a spacing that was ignored. A run that was stopped has
// not come to check distances: its mesh promises none, and `verify` asks for the usual one.
std::vector<std::string> kept_notes(const Parameters& parameters, const MeshingResult& result);
// Smoothing, the side that is inside, and a closed boundary; none where the field is that of the volume.
std::vector<std::string> field_notes(const Parameters& parameters);

}  // namespace deliso
