#include "experiments/lesson/lesson_page.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "delaunay/base/check.h"
#include "experiments/config/json.h"
#include "experiments/lesson/lesson_modules.h"
#include "experiments/lesson/packed_text.h"

namespace deliso {
namespace {

constexpr int kMostAttempts = 6;

// All modules whose names end like this, one after the other.
std::string modules_of_kind(std::string_view ending) {
  std::string text;
  for (const LessonModule& module : lesson_modules()) {
    if (module.name.ends_with(ending)) text += module.text;
  }
  return text;
}

// The one module of this file.
std::string module_text(std::string_view file) {
  for (const LessonModule& module : lesson_modules()) {
    if (module.name.ends_with(file)) return std::string(module.text);
  }
  throw InternalError("no module " + std::string(file));
}

// Puts a text in the place of the mark, which occurs once.
void put(std::string& page, std::string_view mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw InternalError("the page has no place for " + std::string(mark));
  page.replace(at, mark.size(), text);
}

// Titles come from the program, but may name files.
std::string escaped_for_html(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

struct PackedData {
  std::size_t length = 0;  // of the text
  std::string packed;
};

// All that the page knows, with so many events of stage 2 of each run.
PackedData packed_data(Json data, const std::vector<LessonRun>& runs, std::size_t most_events) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    data["runs"].push_back(lesson_data(runs[i], i == 0 ? LessonPart::kWhole : LessonPart::kStage2, most_events));
  }
  const std::string text = json_line(data);
  return {text.size(), packed_text(text)};
}

// With as many of these events as have room. How far they can be packed is known when they are.
PackedData fitting_data(const Json& data, const std::vector<LessonRun>& runs, std::size_t room) {
  std::size_t most_events = 0;
  for (const LessonRun& run : runs) most_events = std::max(most_events, run.events.size());
  PackedData all = packed_data(data, runs, most_events);
  if (all.packed.size() <= room) return all;
  PackedData found = packed_data(data, runs, 0);
  if (found.packed.size() >= room) return found;
  double share =
      static_cast<double>(room - found.packed.size()) / static_cast<double>(all.packed.size() - found.packed.size());
  for (int attempt = 0; attempt < kMostAttempts; ++attempt, share *= 0.93) {
    PackedData some = packed_data(data, runs, static_cast<std::size_t>(share * static_cast<double>(most_events)));
    if (some.packed.size() <= room) return some;
  }
  return found;
}

}  // namespace

std::string lesson_page(const LessonOptions& options, std::size_t most_bytes) {
  std::string page = modules_of_kind(".html");
  put(page, "@TITLE@", escaped_for_html(options.title));
  put(page, "@STYLE@", modules_of_kind(".css"));
  // As text, because the numbers of JavaScript end before those of 64 bits do.
  Json data = {{"title", options.title},
               {"seed", std::to_string(options.seed)},
               {"answers", options.shows_answers},
               {"glossary", module_text("glossary.md")},
               {"runs", Json::array()}};
  if (options.experiments != nullptr) {
    data["experiments"] = *options.experiments;
    data["errata"] = module_text("errata.md");
  }
  if (!options.figure.empty()) data["figure"] = options.figure;
  const std::string scripts = modules_of_kind(".js");
  const std::size_t room = most_bytes - std::min(most_bytes, page.size() + scripts.size());
  const PackedData packed =
      fitting_data(data, options.runs == nullptr ? std::vector<LessonRun>() : *options.runs, room);
  put(page, "@LENGTH@", std::to_string(packed.length));
  put(page, "@DATA@", packed.packed);
  put(page, "@SCRIPTS@", scripts);
  return page;
}

}  // namespace deliso
