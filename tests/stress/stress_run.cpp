#include "tests/stress/stress_run.h"

#include <algorithm>
#include <ctime>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "surface/deliso.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/verification/verification.h"

namespace deliso::testing {

namespace {

MeshingOptions options_of(const StressCase& stress_case, double most_seconds) {
  MeshingOptions options;
  // Small volumes are refined to hundredths of a voxel: harder than by default.
  options.parameters.r_min_of = RMinOf::kBox;
  if (stress_case.is_closed) options.parameters.boundary = Boundary::kClosed;
  for (const auto& [key, value] : stress_case.sets) {
    if (key == "stage2.r_min") options.parameters.stage2.r_min = value;
  }
  options.parameters.budget.seconds = most_seconds;
  return options;
}

// Of this process: other programs on the machine do not count.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The mesh as a user would have it: from a file.
TriangleMesh read_back(const TriangleMesh& mesh, const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "mesh.ply";
  write_mesh(mesh, path);
  return read_mesh(path);
}

}  // namespace

StressResult run_stress_case(const StressCase& stress_case, double most_seconds,
                             const std::filesystem::path& directory) {
  StressResult result;
  const double start = processor_seconds();
  try {
    const MeshingResult made =
        mesh_isosurface(stress_case.grid, stress_case.isovalue, options_of(stress_case, most_seconds));
    result.seconds = processor_seconds() - start;
    result.vertices = static_cast<std::int64_t>(made.mesh.points.size());
    const ScalarGrid& grid = stress_case.grid;
    const MeshedField field = meshed_field(grid, stress_case.isovalue, {}, stress_case.is_closed, grid.spacing(), 1);
    const Verification verified = verify_mesh(read_back(made.mesh, directory), field.grid, field.isovalue);
    const bool says_proven = is_proven(made.certificate);
    if (made.stopped_early()) {
      result.outcome = Outcome::kStopped;
    } else if (says_proven) {
      result.outcome = verified.proven ? Outcome::kProven : Outcome::kContradicted;
    } else {
      result.outcome = verified.proven ? Outcome::kAlarm : Outcome::kTold;
    }
    for (const std::string& text : made.certificate.differences) result.reasons.push_back("mesh: " + text);
    for (const std::string& text : made.certificate.broken) result.reasons.push_back("mesh: " + text);
    for (const std::string& text : verified.failures) result.reasons.push_back("verify: " + text);
  } catch (const InputError& error) {
    result.outcome = Outcome::kRefused;
    result.reasons.emplace_back(error.what());
  } catch (const InternalError& error) {
    result.seconds = processor_seconds() - start;
    result.reasons.emplace_back(error.what());
  }
  return result;
}

void StressSums::add(const StressResult& result) {
  ++runs;
  proven += result.outcome == Outcome::kProven ? 1 : 0;
  told += result.outcome == Outcome::kTold ? 1 : 0;
  contradicted += result.outcome == Outcome::kContradicted ? 1 : 0;
  alarms += result.outcome == Outcome::kAlarm ? 1 : 0;
  refused += result.outcome == Outcome::kRefused ? 1 : 0;
  stopped += result.outcome == Outcome::kStopped ? 1 : 0;
  broken += result.outcome == Outcome::kBroken ? 1 : 0;
  vertices += result.vertices;
  seconds += result.seconds;
  slowest = std::max(slowest, result.seconds);
}

StressCase make_stress_case(const StressKind& kind, std::uint64_t seed) {
  Rng names(seed);
  for (const char letter : kind.name) names = Rng(names.next() + static_cast<unsigned char>(letter));
  return kind.make(names);
}

std::string commands_of(const StressCase& stress_case, const std::filesystem::path& volume) {
  const std::string given = volume.string() + " --isovalue " + shortest_text(stress_case.isovalue);
  std::string sets = " --set r_min_of=box";
  if (stress_case.is_closed) sets += " --set boundary=closed";
  for (const auto& [key, value] : stress_case.sets) sets += " --set " + std::string(key) + "=" + shortest_text(value);
  return "deliso mesh " + given + sets + " -o m.ply; deliso verify m.ply " + given +
         (stress_case.is_closed ? " --closed" : "");
}

}  // namespace deliso::testing
