// The floors of the house: an include may only point downwards.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

// What each folder may include besides itself.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"delaunay/base", {}},
    {"delaunay", {"delaunay/base"}},
    {"volume", {"delaunay/base"}},
    {"raycast", {"delaunay/base", "volume"}},
    {"surface", {"delaunay/base", "delaunay", "volume", "raycast"}},
    {"experiments", {"delaunay/base", "delaunay", "volume", "raycast", "surface"}},
};

// The folder that a path written from the root belongs to: "delaunay/base" is a floor of its own.
std::string floor_of(const std::string& path) {
  if (path.starts_with("delaunay/base/")) return "delaunay/base";
  return path.substr(0, path.find('/'));
}

// Whether a file of `floor` may include `target`. System headers and generated ones have no floor.
bool may_include(const std::string& floor, const std::string& target) {
  const std::string other = floor_of(target);
  if (other == "tests") return false;
  return other == floor || !kAllowed.contains(other) || kAllowed.at(floor).contains(other);
}

TEST(IncludeDirection, ArrowsPointDownwards) {
  const fs::path root = DELISO_SOURCE_DIR;
  const std::regex include(R"(^\s*#\s*include\s+["<]([^">]+)[">])");
  int files = 0;
  int arrows = 0;
  for (const std::string top : {"delaunay", "volume", "raycast", "surface", "experiments"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      ++files;
      const std::string path = fs::relative(entry.path(), root).string();
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        const std::string target = match[1];
        // Includes are written from the root: what names no folder of ours must not be a file beside this one.
        EXPECT_FALSE(fs::exists(entry.path().parent_path() / target)) << path << " includes " << target;
        EXPECT_TRUE(may_include(floor_of(path), target)) << path << " includes " << target;
        if (kAllowed.contains(floor_of(target))) ++arrows;
      }
    }
  }
  EXPECT_GT(files, 20);
  EXPECT_GT(arrows, 20);
}

TEST(IncludeDirection, WrongArrowsWouldBeSeen) {
  EXPECT_FALSE(may_include("volume", "delaunay/predicates.h"));
  EXPECT_FALSE(may_include("delaunay", "volume/scalar_grid.h"));
  EXPECT_FALSE(may_include("raycast", "delaunay/predicates.h"));
  EXPECT_FALSE(may_include("delaunay/base", "delaunay/ids.h"));
  EXPECT_FALSE(may_include("raycast", "surface/base/parameters.h"));
  EXPECT_FALSE(may_include("surface", "experiments/config/json.h"));
  EXPECT_FALSE(may_include("experiments", "tests/support/program_runner.h"));
  EXPECT_TRUE(may_include("raycast", "volume/scalar_grid.h"));
  EXPECT_TRUE(may_include("volume", "delaunay/base/vec3.h"));
  EXPECT_TRUE(may_include("volume", "zlib.h"));
}

}  // namespace
