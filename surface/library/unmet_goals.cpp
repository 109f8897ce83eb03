// What a report says of goals that were not reached.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"
#include "surface/library/run_report.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {
namespace {

// The stage's name in the paper and in the report.
std::string stage_text(std::string_view stage) {
  if (stage == "recover") return "stage 1 (recover)";
  return stage == "refine" ? "stage 2 (refine)" : "the stage '" + std::string(stage) + "'";
}

std::string what_fewer_do_not_keep(const SizeParameters& size, double distance) {
  return "fewer do not keep the topology, the angles" +
         (size.max_edge ? ", edges of at most " + short_text(*size.max_edge) : std::string()) + " and a distance of " +
         short_text(distance) + (distance == 1 ? " voxel" : " voxels");
}

// The angle and the ratio of longest edge to smallest height asked for, where triangles miss them.
void append_unmet_shapes(const SizeParameters& size, const TriangleMesh& mesh, std::vector<std::string>& goals) {
  if (!size.min_angle && !size.max_aspect) return;
  constexpr double kDegree = std::numbers::pi / 180, kRounding = 1 + 1e-9;
  const double least_wanted = std::sin(size.min_angle.value_or(0) * kDegree);
  std::int64_t small = 0, slender = 0;
  double least = 1, most = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const double sine = sine_of_least_angle(a, b, c), longest = longest_edge({a, b, c});
    const double aspect = longest * longest / norm(cross(b - a, c - a));
    small += sine * kRounding < least_wanted ? 1 : 0;
    slender += size.max_aspect && aspect > kRounding * *size.max_aspect ? 1 : 0;
    least = std::min(least, sine);
    most = std::max(most, aspect);
  }
  if (small > 0) {
    goals.push_back("size.min_angle: " + counted(small, "triangle has", "triangles have") + " a smaller angle than " +
                    short_text(*size.min_angle) + " degrees, the least " + short_text(std::asin(least) / kDegree));
  }
  if (slender > 0) {
    goals.push_back("size.max_aspect: " + counted(slender, "triangle has", "triangles have") +
                    " a longest edge of more than " + short_text(*size.max_aspect) +
                    " times its smallest height, the most " + short_text(most));
  }
}

// The sizes asked for that a run to its end did not reach.
std::vector<std::string> unmet_sizes(const SizeParameters& size, const MeshingResult& result) {
  std::vector<std::string> goals;
  constexpr double kWithin = 0.02;
  const auto count = static_cast<std::int64_t>(result.mesh.points.size());
  if (size.target_vertices) {
    const std::int64_t target = *size.target_vertices;
    const auto wanted = static_cast<double>(target);
    if (std::abs(static_cast<double>(count) - wanted) > kWithin * wanted) {
      goals.push_back("size.target_vertices: " + std::to_string(count) + " vertices were reached, not " +
                      std::to_string(target) + ": " +
                      (count > target ? what_fewer_do_not_keep(size, result.promised_distance)
                                      : "insertions of more were refused"));
    }
  }
  if (size.max_edge && result.longest_edge > *size.max_edge) {
    goals.push_back("size.max_edge: the longest edge has " + short_text(result.longest_edge) + " voxels, not " +
                    short_text(*size.max_edge) + ": insertions beside it were refused");
  }
  append_unmet_shapes(size, result.mesh, goals);
  return goals;
}

}  // namespace

std::vector<std::string> unmet_goals(const MeshingOptions& options, const MeshingResult& result) {
  if (!result.stopped_early()) return unmet_sizes(options.parameters.size, result);
  // Which limit stopped the run: a signal is known, and so are the values of the budgets.
  const BudgetParameters& budget = options.parameters.budget;
  std::string cause = "the budget";
  if (options.stop != nullptr && options.stop->load()) {
    cause = options.stop_cause;
  } else if (budget.max_vertices && static_cast<std::int64_t>(result.mesh.points.size()) >= *budget.max_vertices) {
    cause = "budget.max_vertices = " + std::to_string(*budget.max_vertices);
  } else if (budget.seconds) {
    cause = "budget.seconds = " + JsonTree(*budget.seconds).text();
  }
  std::vector<std::string> goals = {stage_text(result.stopped_in) + " was stopped by " + cause +
                                    " while triangles that violate a criterion were still waiting"};
  if (options.parameters.certify && result.certificate.verdict != Verdict::kHomeomorphic) {
    goals.push_back("the mesh is not proven homeomorphic to the isosurface");
  }
  return goals;
}

}  // namespace deliso
