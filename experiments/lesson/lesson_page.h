// The lesson: one HTML file that needs no other and no network.
#pragma once

#include <cstdint>
#include <string>

namespace deliso {

struct LessonOptions {
  std::string title = "DelIso";
  std::uint64_t seed = 1;  // of what is random in the page: fields, instances of exercises
};

// The page as a whole: the template with the style sheet, the scripts and the data put in. Equal options give equal
// bytes.
std::string lesson_page(const LessonOptions& options);

}  // namespace deliso
