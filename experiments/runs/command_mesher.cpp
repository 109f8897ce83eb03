#include "experiments/runs/command_mesher.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "delaunay/base/shortest_text.h"
#include "surface/mesh/io/mesh_io.h"
#include "volume/io/volume_file.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// A folder for the files of one run, removed with them.
class RunFolder {
 public:
  RunFolder() {
    std::string name = (fs::temp_directory_path() / "deliso-run-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw InputError("cannot make a folder in " + fs::temp_directory_path().string());
    path_ = name;
  }
  ~RunFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

// Calls use(name) for each "{name}" and puts its answer there.
template <class Use>
std::string replace_placeholders(const std::string& text, const Use& use) {
  std::string replaced;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    const std::size_t close = open == std::string::npos ? open : text.find('}', open);
    if (close == std::string::npos) return replaced + text.substr(at);
    replaced += text.substr(at, open - at) + use(text.substr(open + 1, close - open - 1));
    at = close + 1;
  }
  return replaced;
}

// Grid edges whose ends lie on two sides of the isovalue.
std::int64_t crossed_edges(const ScalarGrid& grid, double isovalue) {
  const auto& dims = grid.dims();
  std::int64_t count = 0;
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        const bool is_above = grid.at(i, j, k) > isovalue;
        if (i + 1 < dims[0] && (grid.at(i + 1, j, k) > isovalue) != is_above) ++count;
        if (j + 1 < dims[1] && (grid.at(i, j + 1, k) > isovalue) != is_above) ++count;
        if (k + 1 < dims[2] && (grid.at(i, j, k + 1) > isovalue) != is_above) ++count;
      }
    }
  }
  return count;
}

// The program's file: a path as it is, a name as PATH has it.
fs::path program_file(const std::string& name) {
  fs::path file = name.find('/') == std::string::npos ? find_program({name}).value_or("") : fs::path(name);
  if (!file.empty() && access(file.c_str(), X_OK) == 0) return file;
  throw InputError("the mesher '" + name + "' is no program that can be started");
}

// The last line that says something, on one line.
std::string last_line(std::string text) {
  constexpr std::size_t kMost = 200;
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  const std::size_t begin = text.rfind('\n');
  if (begin != std::string::npos) text = text.substr(begin + 1);
  return text.size() <= kMost ? text : text.substr(0, kMost) + " ...";
}

void check_ending(const std::string& name, const MesherCommand& command, const ChildResult& child) {
  if (child.is_timed_out) {
    throw InputError("the mesher '" + name + "' did not end within " + shortest_text(command.timeout_seconds) +
                     " s and was ended");
  }
  const auto& accepted = command.exit_codes;
  if (std::find(accepted.begin(), accepted.end(), child.exit_code) != accepted.end()) return;
  const std::string said = last_line(child.err);
  constexpr int kSignals = 128;
  const std::string ending = child.exit_code > kSignals
                                 ? "was ended by signal " + std::to_string(child.exit_code - kSignals)
                                 : "ended with exit code " + std::to_string(child.exit_code);
  throw InputError("the mesher '" + name + "' " + ending + (said.empty() ? "" : ": " + said));
}

TriangleMesh usable_mesh(const std::string& name, const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error) || fs::file_size(file, error) == 0) {
    throw InputError("the mesher '" + name + "' wrote no mesh");
  }
  TriangleMesh mesh;
  try {
    mesh = read_mesh(file);
  } catch (const InputError& mistake) {
    std::string text = mistake.what();
    if (text.starts_with(file.string())) text = "the file" + text.substr(file.string().size());
    throw InputError("the mesher '" + name + "' wrote a mesh that cannot be read: " + text);
  }
  if (mesh.triangles.empty()) throw InputError("the mesher '" + name + "' wrote a mesh without triangles");
  for (const Vec3& p : mesh.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError("the mesher '" + name + "' wrote a mesh with a coordinate that is no number");
    }
  }
  return mesh;
}

Json read_report(const std::string& name, const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return Json::object();
  Json report;
  try {
    report = read_json(file);
  } catch (const InputError&) {
    report = nullptr;
  }
  if (!report.is_object()) throw InputError("the mesher '" + name + "' wrote a report that is no JSON object");
  return report;
}

}  // namespace

void check_placeholders(const std::vector<std::string>& arguments, const std::string& place) {
  const std::vector<std::string> known(kPlaceholders.begin(), kPlaceholders.end());
  std::vector<std::string> found;
  for (const std::string& argument : arguments) {
    replace_placeholders(argument, [&](const std::string& name) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw InputError(std::string(place).append(" has an unknown placeholder {").append(name).append("}") +
                         nearest_name_hint(name, known));
      }
      found.push_back(name);
      return std::string();
    });
  }
  for (const std::string needed : {"volume", "mesh"}) {
    if (std::find(found.begin(), found.end(), needed) == found.end()) {
      throw InputError(std::string(place).append(" has no argument with {").append(needed).append("}"));
    }
  }
}

CommandOutcome run_command_mesher(const MesherCommand& command, const CommandInput& input, ProgramLauncher& launcher) {
  const RunFolder folder;
  const fs::path volume = folder / "volume.nrrd";
  const fs::path mesh = folder / ("mesh." + command.mesh_format);
  const fs::path report = folder / "report.json";
  write_volume(input.grid, volume, NrrdEncoding::kRaw);
  const std::map<std::string, std::string> values = {
      {"volume", volume.string()},
      {"isovalue", shortest_text(input.isovalue)},
      {"mesh", mesh.string()},
      {"report", report.string()},
      {"vertices", std::to_string(crossed_edges(input.grid, input.isovalue))},
      {"seed", std::to_string(input.seed)},
      {"threads", std::to_string(input.threads)},
      {"deliso", fs::read_symlink("/proc/self/exe").string()}};
  std::vector<std::string> arguments;
  for (const std::string& argument : command.arguments) {
    arguments.push_back(replace_placeholders(argument, [&](const std::string& name) { return values.at(name); }));
  }
  const fs::path program = program_file(arguments.front());
  const std::string name = program.filename().string();
  arguments.erase(arguments.begin());

  CommandOutcome outcome;
  outcome.child = launcher.run(program.string(), arguments, command.timeout_seconds, input.stop);
  outcome.is_stopped = outcome.child.is_stopped;
  if (outcome.is_stopped) return outcome;
  check_ending(name, command, outcome.child);
  outcome.mesh = usable_mesh(name, mesh);
  outcome.report = read_report(name, report);
  return outcome;
}

Json command_json(const CommandOutcome& outcome) {
  const auto reported = [&outcome](const char* key, bool is_text) {
    if (!outcome.report.contains(key)) return Json();
    const Json& value = outcome.report[key];
    return (is_text ? value.is_string() : value.is_number()) ? value : Json();
  };
  const ChildResult& child = outcome.child;
  return Json{{"exit_code", child.exit_code},
              {"wall_seconds", child.wall_seconds},
              {"user_seconds", child.user_seconds},
              {"system_seconds", child.system_seconds},
              {"peak_memory_bytes", child.peak_memory_bytes},
              {"cold_seconds", reported("total_seconds", false)},
              {"warm_seconds", reported("warm_seconds", false)},
              {"version", reported("version", true)},
              {"settings", reported("settings", true)}};
}

}  // namespace deliso
