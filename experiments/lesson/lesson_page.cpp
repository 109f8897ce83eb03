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

// Of the data of a page: what a browser unpacks and reads in a moment.
constexpr std::size_t kMostUnpacked = 8'000'000;
constexpr int kMostAttempts = 4;

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

// All that the page knows, in about so many bytes. The main run may take most of them; the others get what it leaves.
std::string data_text(Json data, const std::vector<LessonRun>& runs, std::size_t most_bytes) {
  std::size_t room = most_bytes - std::min(most_bytes, data.dump().size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t share = i + 1 < runs.size() ? room * 3 / 5 : room;
    data["runs"].push_back(lesson_data(runs[i], i == 0 ? LessonPart::kWhole : LessonPart::kStage2, share));
    room -= std::min(room, data["runs"].back().dump().size());
  }
  return data.dump();
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
  // How far the data can be packed is known when they are.
  std::string text, packed;
  std::size_t unpacked = kMostUnpacked;
  for (int attempt = 0; attempt < kMostAttempts && (attempt == 0 || packed.size() > room); ++attempt) {
    text = data_text(data, options.runs == nullptr ? std::vector<LessonRun>() : *options.runs, unpacked);
    packed = packed_text(text);
    unpacked = static_cast<std::size_t>(0.95 * static_cast<double>(text.size()) * static_cast<double>(room) /
                                        static_cast<double>(packed.size()));
  }
  put(page, "@LENGTH@", std::to_string(text.size()));
  put(page, "@DATA@", packed);
  put(page, "@SCRIPTS@", scripts);
  return page;
}

}  // namespace deliso
