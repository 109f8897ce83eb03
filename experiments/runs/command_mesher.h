// Another program as the mesher of a run: started, timed, and its mesh read.
//
// Its arguments may hold placeholders:
//   {volume}    the volume as NRRD, raw, with the spacing and origin of the data set    {isovalue}  the isovalue
//   {mesh}      the file to write, with the extension "mesh_format"                     {report}    a JSON file it may
//   write {vertices}  the number of grid edges that the isosurface crosses, which is the number of vertices of marching
//   cubes {seed}      the seed of the run      {threads}  of the run      {deliso}  this program
//
// A report may hold "total_seconds", the time of the meshing alone as the program starts (cold), from the volume in
// memory to the mesh in memory; "warm_seconds", the same once more in the same process; "version"; and "settings".
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"
#include "experiments/system/program_launcher.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"

namespace deliso {

inline constexpr std::array<std::string_view, 8> kPlaceholders = {"volume",   "isovalue", "mesh",    "report",
                                                                  "vertices", "seed",     "threads", "deliso"};

// Throws InputError, beginning with `place`, when an argument has an unknown placeholder, or when no argument has
// {volume} or {mesh}.
void check_placeholders(const std::vector<std::string>& arguments, const std::string& place);

struct CommandInput {
  const ScalarGrid& grid;
  double isovalue = 0;
  std::uint64_t seed = 1;
  std::int32_t threads = 1;
  const std::atomic<bool>* stop = nullptr;
};

struct CommandOutcome {
  bool is_stopped = false;  // from outside; the rest is empty then
  TriangleMesh mesh;
  ChildResult child;
  Json report = Json::object();  // what the program reported
};

// Runs the program in a folder of its own, which is removed. Throws InputError, in one sentence, when the program is
// not there, fails, takes too long, writes no mesh or one that cannot be used.
CommandOutcome run_command_mesher(const MesherCommand& command, const CommandInput& input, ProgramLauncher& launcher);

// The key "command" of a record.
Json command_json(const CommandOutcome& outcome);

}  // namespace deliso
