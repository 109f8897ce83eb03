// A real run as the page shows it: its trace, cut to what a page can hold, and what the trace stands on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/deliso.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Moving nlohmann's JSON is not declared noexcept. NOLINTNEXTLINE(bugprone-exception-escape)
struct LessonRun {
  std::string name;          // as the page calls it
  std::vector<Json> events;  // the whole trace (experiments/lesson/trace/trace_writer.h)
  MeshingResult result;
  Json limits;  // of stage 1: epsilon, rho; and which pole gives the height
  Json rays;    // see lesson_rays.h
  Json cells;   // see lesson_cells.h
  Json
      volume;  // dims, step (of the grid in mesh space), samples less the isovalue; and an approximation of the surface
};

// Runs the program under an observer. Throws InputError as mesh_isosurface() does, and where the run is too large to be
// followed step by step.
LessonRun run_observed(std::string name, const ScalarGrid& grid, double isovalue, MeshingOptions options);

// The run as data of the page: of stage 2 the first `most_events` events, the others are counted. Numbers have six
// digits, coordinates five behind the point; points of stage 1 have all of theirs.
enum class LessonPart { kWhole, kStage2 };
Json lesson_data(const LessonRun& run, LessonPart part, std::size_t most_events);

}  // namespace deliso
