// The record of one run (`--report`): everything needed to repeat it, and its results, as one JSON object.
//
// Times are wall-clock seconds on the steady clock. `total_seconds` is the mesher's own time, from the volume in memory
// to the certified mesh; reading the volume, hashing it and writing files is outside it. `stages.*.seconds` add up to
// it. A quotient without a denominator (seconds per insertion without insertions) is null.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/certificate/certificate.h"
#include "surface/deliso.h"
#include "surface/library/json_tree.h"
#include "surface/library/run_report.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The layout of the report; it gets a new name whenever a key changes its meaning.
inline constexpr const char* kReportSchema = "deliso-report-1";

Json json_of(const JsonTree& tree);

// version, commit, compiler, flags, cpu.
Json program_json();

// path, dims, samples (their number), spacing, origin, type, range, sha256 (of the raw samples, little endian; found
// here unless it is given).
Json volume_json(const std::filesystem::path& path, const ScalarGrid& grid, const std::string& sha256 = "");

// [{euler_characteristic, boundary_loops, count}].
Json topology_json(const std::vector<TopologyCount>& counts);

// verdict, manifold, oriented, mesh, isosurface, differences.
Json certificate_json(const Certificate& certificate);

// min_angle_histogram: triangles by their smallest angle, in bins of 5 degrees.
Json quality_json(const MeshQuality& quality);

// The input of a run of the mesher.
struct MeshRun {
  std::filesystem::path volume_path;
  const ScalarGrid& grid;
  double isovalue = 0;
  const MeshingOptions& options;
  std::string volume_sha256{};           // empty: not known yet
  const MeshQuality* quality = nullptr;  // of the mesh, where it is known
};

// The report of `deliso mesh`.
Json mesh_report(const MeshRun& run, const MeshingResult& result);

}  // namespace deliso
