// The modules of the lesson's page, which the build puts into the program (embed_modules.cmake).
#pragma once

#include <span>
#include <string_view>

namespace deliso {

struct LessonModule {
  std::string_view name;  // the file, by its path from experiments/lesson
  std::string_view text;
};

// In the order of modules.txt, in which scripts have to run.
std::span<const LessonModule> lesson_modules();

}  // namespace deliso
