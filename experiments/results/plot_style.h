// What all plots look like.
#pragma once

#include <string_view>

namespace deliso {

inline constexpr double kTitleSize = 15;  // pixels
inline constexpr double kNameSize = 12;   // of names of things
inline constexpr double kTickSize = 11;   // of the numbers at an axis
inline constexpr std::string_view kGridColor = "#e4e4e4";

}  // namespace deliso
