// One picture of the lesson as an SVG file, for slides: the page draws it, in a browser without a screen.
#pragma once

#include <string>

#include "experiments/lesson/lesson_page.h"

namespace deliso {

// The picture at an address of the page, CHAPTER/STEP. Throws InputError when there is no such picture, or no browser:
// Chromium in PATH, or the one that DELISO_BROWSER names.
std::string lesson_figure(LessonOptions options, const std::string& address);

}  // namespace deliso
