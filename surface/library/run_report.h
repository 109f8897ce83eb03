// What a run tells of itself: the parts of `--report` that the mesher knows, for the program and the library.
//
// Times are wall-clock seconds on the steady clock. `total_seconds` is the mesher's own time, from the volume in memory
// to the certified mesh; `stages.*.seconds` add up to it. A quotient without a denominator (seconds per insertion
// without insertions) is null, and so is the distance promised where a run was stopped before it was checked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/certificate/certificate.h"
#include "surface/deliso.h"
#include "surface/library/json_tree.h"
#include "surface/mesh/mesh_quality.h"
#include "volume/affine.h"

namespace deliso {

// [{euler_characteristic, boundary_loops, count}].
JsonTree topology_tree(const std::vector<TopologyCount>& counts);

// verdict, manifold, oriented, mesh, isosurface, differences, proven, broken.
JsonTree certificate_tree(const Certificate& certificate);

// min_angle_histogram: triangles by their smallest angle, in bins of 5 degrees.
JsonTree quality_tree(const MeshQuality& quality);

// Every parameter, also those that have their default.
JsonTree parameters_tree(const Parameters& parameters);

// The name of a verdict in JSON.
std::string verdict_name(Verdict verdict);

// Euler characteristic, boundary loops and number of components of a whole surface.
struct TopologySum {
  std::int64_t components = 0;
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
};
TopologySum sum_of(const std::vector<TopologyCount>& counts);

// The topology of the mesh of a result, certified or not. (The mesher's meshes are manifold.)
std::vector<TopologyCount> mesh_topology(const MeshingResult& result);

// What a run that stopped early left undone, or the sizes that another one did not reach, one sentence each.
std::vector<std::string> unmet_goals(const MeshingOptions& options, const MeshingResult& result);

// Moves the positions that a report tells, of poor triangles and of what was left out, with the mesh into the world.
void move_positions(const Affine& to_world, MeshingResult& result);

// The report of a run, but for what only its caller knows: the program, the volume's file.
JsonTree run_report(double isovalue, const MeshingOptions& options, const MeshingResult& result,
                    const MeshQuality& quality);

}  // namespace deliso
