#include "experiments/lesson/lesson_figure.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "delaunay/base/check.h"
#include "experiments/system/child_program.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

constexpr double kMostPictureSeconds = 120;

fs::path find_browser() {
  const char* const chosen = std::getenv("DELISO_BROWSER");
  if (chosen != nullptr && *chosen != '\0') return chosen;
  const auto found = find_program({"chromium", "chromium-browser", "google-chrome"});
  if (found) return *found;
  throw InputError("--figure: no browser that draws it is installed: install Chromium, or name one in DELISO_BROWSER");
}

// A folder that goes when this does.
class ScratchFolder {
 public:
  ScratchFolder() : path_((fs::temp_directory_path() / "deliso-figure-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw InputError("--figure: no folder can be made in " + path_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] fs::path path() const { return path_; }

 private:
  std::string path_;
};

// The text of the element with this id, or nothing.
std::optional<std::string> text_of_element(const std::string& page, const std::string& id) {
  const std::string begin = "<pre id=\"" + id + "\">";
  const std::size_t from = page.rfind(begin), to = page.find("</pre>", from);
  if (from == std::string::npos || to == std::string::npos) return std::nullopt;
  std::string text = page.substr(from + begin.size(), to - from - begin.size());
  constexpr std::array<std::pair<const char*, const char*>, 4> kEscapes = {
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&nbsp;", "\u00a0"}, {"&amp;", "&"}}};
  for (const auto& [escape, plain] : kEscapes) {
    for (std::size_t at = text.find(escape); at != std::string::npos; at = text.find(escape, at + 1)) {
      text.replace(at, std::string(escape).size(), plain);
    }
  }
  return text;
}

}  // namespace

std::string lesson_figure(LessonOptions options, const std::string& address) {
  const fs::path browser = find_browser();
  const ScratchFolder folder;
  options.figure = address;
  const fs::path page = folder.path() / "lesson.html";
  std::ofstream(page) << lesson_page(options);
  const ChildResult result =
      run_child(browser,
                {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--user-data-dir=" + (folder.path() / "profile").string(), "--dump-dom", "file://" + page.string()},
                kMostPictureSeconds);
  if (const auto svg = text_of_element(result.out, "figure")) return *svg;
  if (const auto refusal = text_of_element(result.out, "figure-refusal")) throw InputError("--figure: " + *refusal);
  throw InputError("--figure: " + browser.string() + " has drawn nothing (exit code " +
                   std::to_string(result.exit_code) + ")");
}

}  // namespace deliso
