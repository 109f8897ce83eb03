// The layers of the project: an include may only point to a lower layer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

// The top folders that each top folder may include besides itself. A folder named with its parent is separate from it.
const std::map<std::string, std::set<std::string>> kBelow = {
    {"delaunay/base", {}},
    {"delaunay", {"delaunay/base"}},
    {"volume", {"delaunay/base"}},
    {"raycast", {"delaunay/base", "volume"}},
    {"surface", {"delaunay/base", "delaunay", "volume", "raycast"}},
    {"experiments", {"delaunay/base", "delaunay", "volume", "raycast", "surface"}},
};

// The layers within a top folder, from the lowest up. Folders of one layer do not include each other.
using Floors = std::vector<std::set<std::string>>;
const std::map<std::string, Floors> kFloors = {
    {"volume",
     {{"volume"},
      {"volume/io/base", "volume/topology", "volume/fields", "volume/filters"},
      {"volume/io/nrrd", "volume/io/nifti", "volume/io/metaimage", "volume/io/vtk", "volume/io/numpy", "volume/io/mrc",
       "volume/io/inr", "volume/io/pvm", "volume/io/raw", "volume/io/itk"},
      {"volume/io"},
      {"volume/marching_cubes"}}},
    {"surface",
     {{"surface/base", "surface/library/deliso"},
      {"surface/mesh"},
      {"surface/mesh/io", "surface/search"},
      {"surface/restricted", "surface/intersection", "surface/certificate/cells"},
      {"surface/extract", "surface/recover"},
      {"surface/certificate", "surface/refine/disk"},
      {"surface/refine/guard", "surface/refine/slabs"},
      {"surface/refine"},
      {"surface/shape"},
      {"surface/sizes"},
      {"surface/verification"},
      {"surface/repair/lattice"},
      {"surface/repair/signs"},
      {"surface/repair/diagnosis"},
      {"surface/repair/finish"},
      {"surface/repair/rounds"},
      {"surface/repair"},
      {"surface"},
      {"surface/library"}}},
    {"experiments",
     {{"experiments/system", "experiments/python"},
      {"experiments/config", "experiments/pictures"},
      {"experiments/runs", "experiments/lesson/trace"},
      {"experiments/results"},
      {"experiments/lesson"},
      {"experiments/commands"},
      {"experiments"}}},
};

// The most source files that a folder may hold of its own.
constexpr int kMostFiles = 40;

std::string folder_of(const std::string& path) { return path.substr(0, std::min(path.rfind('/'), path.size())); }

// The top folder that a path belongs to: "delaunay/base" counts as one.
std::string top_of(const std::string& path) {
  if (path.starts_with("delaunay/base/")) return "delaunay/base";
  return path.substr(0, path.find('/'));
}

// The floor of a folder, counted from the ground; kNowhere when the list of floors lacks it.
constexpr std::size_t kNowhere = ~std::size_t{0};
std::size_t floor_of(const std::string& folder, const Floors& floors) {
  const auto has_folder = [&](const std::set<std::string>& rooms) { return rooms.contains(folder); };
  const auto found = std::find_if(floors.begin(), floors.end(), has_folder);
  return found == floors.end() ? kNowhere : static_cast<std::size_t>(found - floors.begin());
}

// Whether the file `path` may include `target`. System headers and generated ones belong to no folder of ours.
bool may_include(const std::string& path, const std::string& target) {
  const std::string top = top_of(path), other = top_of(target);
  if (other == "tests") return false;
  if (!kBelow.contains(other)) return true;
  if (top != other) return kBelow.at(top).contains(other);
  if (!kFloors.contains(top) || folder_of(path) == folder_of(target)) return true;
  const std::size_t own = floor_of(folder_of(path), kFloors.at(top));
  const std::size_t its = floor_of(folder_of(target), kFloors.at(top));
  return own != kNowhere && its != kNowhere && its < own;
}

// The source files of the product, by their paths from the root.
std::vector<std::string> source_files() {
  const fs::path root = DELISO_SOURCE_DIR;
  std::vector<std::string> files;
  for (const char* top : {"delaunay", "volume", "raycast", "surface", "experiments"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const bool is_source = entry.path().extension() == ".h" || entry.path().extension() == ".cpp";
      if (is_source) files.push_back(fs::relative(entry.path(), root).string());
    }
  }
  return files;
}

TEST(IncludeDirection, ArrowsPointDownwards) {
  const fs::path root = DELISO_SOURCE_DIR;
  const std::regex include(R"(^\s*#\s*include\s+["<]([^">]+)[">])");
  int arrows = 0;
  for (const std::string& path : source_files()) {
    std::ifstream stream(root / path);
    for (std::string line; std::getline(stream, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string target = match[1];
      // Includes are written from the root: what names no folder of ours must not be a file beside this one.
      EXPECT_FALSE(fs::exists((root / path).parent_path() / target)) << path << " includes " << target;
      EXPECT_TRUE(may_include(path, target)) << path << " includes " << target;
      if (kBelow.contains(top_of(target))) ++arrows;
    }
  }
  EXPECT_GT(arrows, 500);
}

TEST(IncludeDirection, EveryFolderHasAFloor) {
  int files = 0;
  for (const std::string& path : source_files()) {
    ++files;
    const auto floors = kFloors.find(top_of(path));
    if (floors == kFloors.end()) continue;
    EXPECT_NE(floor_of(folder_of(path), floors->second), kNowhere) << path << " stands on no floor of the list above";
  }
  EXPECT_GT(files, 300);
}

TEST(IncludeDirection, NoFolderIsCrowded) {
  std::map<std::string, int> files;
  for (const std::string& path : source_files()) ++files[folder_of(path)];
  for (const auto& [folder, count] : files) EXPECT_LE(count, kMostFiles) << folder;
}

TEST(IncludeDirection, WrongArrowsWouldBeSeen) {
  constexpr std::array<std::pair<const char*, const char*>, 12> kWrong = {{
      {"volume/scalar_grid.h", "delaunay/predicates.h"},
      {"volume/scalar_grid.h", "volume/io/nrrd/nrrd.h"},
      {"volume/topology/exact_topology.h", "volume/marching_cubes/marching_cubes.h"},
      {"delaunay/predicates.h", "volume/scalar_grid.h"},
      {"delaunay/base/vec3.h", "delaunay/ids.h"},
      {"raycast/line.h", "delaunay/predicates.h"},
      {"raycast/line.h", "surface/base/parameters.h"},
      {"surface/recover/recover.h", "surface/extract/facet_pairing.h"},
      {"surface/refine/refine.h", "surface/repair/repair.h"},
      {"surface/deliso.h", "experiments/config/json.h"},
      {"surface/library/deliso/deliso.h", "surface/deliso.h"},
      {"experiments/runs/runner.cpp", "tests/support/program_runner.h"},
  }};
  for (const auto& [path, target] : kWrong) EXPECT_FALSE(may_include(path, target)) << path << " includes " << target;
  EXPECT_TRUE(may_include("raycast/line.h", "volume/scalar_grid.h"));
  EXPECT_TRUE(may_include("volume/scalar_grid.h", "delaunay/base/vec3.h"));
  EXPECT_TRUE(may_include("volume/io/nrrd/nrrd.h", "volume/scalar_grid.h"));
  EXPECT_TRUE(may_include("volume/io/base/gzip_stream.cpp", "zlib.h"));
  EXPECT_TRUE(may_include("surface/deliso.h", "surface/repair/repair.h"));
}

}  // namespace
