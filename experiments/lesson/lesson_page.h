// The lesson: one HTML file that needs no other and no network.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/lesson/lesson_run.h"

namespace deliso {

struct LessonOptions {
  std::string title = "DelIso";
  std::uint64_t seed = 1;                        // of what is random in the page: fields, instances of exercises
  bool shows_answers = false;                    // of exercises, before they are tried
  std::string figure = {};                       // the address of the one picture that is shown instead of the page
  const Json* experiments = nullptr;             // of lesson_experiments.h, with their tables; none: without chapter 11
  const std::vector<LessonRun>* runs = nullptr;  // that the page plays: the main one, then others
};

// The page as a whole: the template with the style sheet, the scripts and the data put in. Equal options give equal
// bytes. Runs are cut so that the page has about `most_bytes` at most.
std::string lesson_page(const LessonOptions& options, std::size_t most_bytes = 1'950'000);

}  // namespace deliso
