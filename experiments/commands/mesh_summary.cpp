#include "experiments/commands/mesh_summary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/size_options.h"
#include "experiments/runs/record.h"
#include "experiments/system/text_table.h"
#include "surface/base/sizes.h"
#include "volume/regular_isovalue.h"

namespace deliso {
namespace {

// An isovalue close to a sample value, as 60.01 among integers, leaves walls and tips as thin as the rest of the gap.
// The middle of the gap has the same samples inside.
void remark_gap(const MeshingResult& result, const ScalarGrid& grid, double isovalue) {
  constexpr double kMany = 0.05, kClose = 0.05;  // of the crossings; of the gap. Values without steps have 2 % there.
  if (result.share_near_samples < kMany || result.isovalue_used != isovalue) return;
  const auto [lower, higher] = samples_around(grid, isovalue);
  const double gap = higher - lower;
  if (!std::isfinite(gap)) return;  // closed along the box, all may be inside
  if (std::min(isovalue - lower, higher - isovalue) >= kClose * gap) return;
  std::cerr
      << "deliso: " << number_text(std::round(100 * result.share_near_samples))
      << " % of the crossings with grid edges are within a hundredth of a voxel of a sample, which takes long and "
      << "leaves small angles; no sample lies between " << shortest_text(lower) << " and " << shortest_text(higher)
      << ", so --isovalue " << shortest_text(lower + gap / 2) << " has the same samples inside\n";
}

// The triangles that could not be brought to the angle asked for, and where the worst of them is.
void remark_shape(const ShapeStats& shape, const Parameters& parameters) {
  if (shape.bad_after == 0) return;
  const double wanted = shape_options(parameters).min_angle * 180 / std::numbers::pi;
  const BadTriangle& worst = shape.worst.front();
  std::cerr << "deliso: " << shape.bad_after << (shape.bad_after == 1 ? " triangle has" : " triangles have")
            << " an angle below " << number_text(wanted) << " degrees, at creases and necks of the isosurface; the "
            << "worst, of " << number_text(worst.degrees()) << " degrees, at " << number_text(worst.centroid.x) << ' '
            << number_text(worst.centroid.y) << ' ' << number_text(worst.centroid.z) << '\n';
}

// Without the stage that improves them.
void remark_unimproved_angles(const Meshed& meshed) {
  constexpr double kSmall = 1;
  const double least = meshed.quality.min_angle_degrees;
  const MeshingResult& result = meshed.result;
  if (result.shape.seconds > 0 || result.stopped_early() || result.mesh.triangles.empty() || least >= kSmall) return;
  std::cerr << "deliso: the least angle is " << number_text(least)
            << " degrees: with these parameters no stage improves small ones (shape.rounds)\n";
}

}  // namespace

void print_summary(const Meshed& meshed, std::ostream& stream) {
  const MeshingResult& result = meshed.result;
  const TopologySum topology = sum_of(mesh_topology(result));
  const std::string field = field_text(meshed.chosen.parameters);
  TextTable table;
  if (!field.empty()) table.row({"field", field});
  table.row({"vertices", std::to_string(result.mesh.points.size())})
      .row({"triangles", std::to_string(result.mesh.triangles.size())})
      .row({"components", std::to_string(topology.components)})
      .row({"euler characteristic", std::to_string(topology.euler_characteristic)})
      .row({"boundary loops", std::to_string(topology.boundary_loops)})
      .row({"verdict", verdict_name(result.certificate.verdict)})
      .row({"min angle (degrees)", number_text(meshed.quality.min_angle_degrees)})
      .row({"seconds", number_text(result.total_seconds)});
  table.print(stream);
  if (result.certificate.verdict == Verdict::kNotChecked || result.stopped_early()) return;
  stream << '\n'
         << (is_proven(result.certificate) ? "proven" : "not proven") << (field.empty() ? "" : ": " + field)
         << " (a proven mesh is manifold, oriented and homeomorphic to the isosurface component by component, no "
         << "triangles cross or touch, its vertices lie on the isosurface, and distances both ways"
         << (is_measured_within_cells(meshed.meshing.parameters)
                 ? ""
                 : ", those of the isosurface at its crossings with grid edges,")
         << " are at most " << number_text(result.promised_distance) << " voxel"
         << (meshed.chosen.parameters.smooth ? "; all of the smoothed field" : "") << ")\n";
}

void print_remarks(const Meshed& meshed) {
  const MeshingResult& result = meshed.result;
  const ChosenField& chosen = meshed.chosen;
  const Parameters& parameters = meshed.meshing.parameters;
  const bool is_as_read = !chosen.parameters.label && !chosen.parameters.smooth;
  remark_isovalue(is_as_read ? &chosen.grid : nullptr, chosen.isovalue, result.isovalue_used);
  if (is_as_read) remark_gap(result, chosen.grid, chosen.isovalue);
  remark_shape(result.shape, parameters);
  remark_unimproved_angles(meshed);
  for (const std::string& remark : size_remarks(parameters, result)) std::cerr << "deliso: " << remark << '\n';
  for (const std::string& goal : unmet_goals(meshed.meshing, result)) std::cerr << "deliso: " << goal << '\n';
  constexpr std::size_t kShown = 10;
  const std::vector<std::string>& differences = result.certificate.differences;
  for (std::size_t i = 0; i < std::min(kShown, differences.size()); ++i) {
    std::cerr << "deliso: " << differences[i] << '\n';
  }
  for (const std::string& broken : result.certificate.broken) std::cerr << "deliso: not proven: " << broken << '\n';
  if (differences.size() > kShown) {
    std::cerr << "deliso: " << differences.size() - kShown << " more differences stand in the report\n";
  }
}

}  // namespace deliso
