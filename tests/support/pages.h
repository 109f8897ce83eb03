// The pages that lead through the project (README.md and those of the folders), for tests of what they say.
// A page is any file .md below a top folder; each top folder and wing has one of the name README.md.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace deliso::testing {

inline std::filesystem::path root() { return DELISO_SOURCE_DIR; }

inline std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}
inline std::string page_text(const std::string& page) { return read_text(root() / page); }

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The folders whose files a page may name.
inline constexpr std::string_view kTopFolders[] = {"delaunay",    "volume",  "raycast", "surface",
                                                   "experiments", "configs", "tests"};

// The wings of surface/: its folders.
inline std::vector<std::string> surface_wings() {
  std::vector<std::string> wings;
  for (const auto& entry : std::filesystem::directory_iterator(root() / "surface")) {
    if (entry.is_directory()) wings.push_back("surface/" + entry.path().filename().string());
  }
  return wings;
}

// All pages, by their paths from the root.
inline std::vector<std::string> all_pages() {
  std::vector<std::string> pages = {"README.md"};
  for (const std::string_view top : kTopFolders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root() / top)) {
      if (entry.path().extension() != ".md") continue;
      pages.push_back(std::filesystem::relative(entry.path(), root()).string());
    }
  }
  return pages;
}

}  // namespace deliso::testing
