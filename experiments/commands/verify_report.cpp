#include "experiments/commands/verify_report.h"

#include <string>
#include <string_view>
#include <vector>

#include "experiments/runs/record.h"
#include "experiments/system/text_table.h"

namespace deliso {
namespace {

Json place_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

Json distance_json(const DistanceFigure& figure) {
  return Json{
      {"max_voxels", figure.max_voxels}, {"mean_voxels", figure.mean_voxels}, {"worst", place_json(figure.worst)}};
}

Json places_json(const std::vector<Vec3>& places) {
  Json list = Json::array();
  for (const Vec3& p : places) list.push_back(place_json(p));
  return list;
}

// Pairs of triangles by their numbers in the mesh, and where they meet.
Json pairs_json(const std::vector<TrianglePair>& pairs) {
  Json list = Json::array();
  for (const TrianglePair& pair : pairs) {
    list.push_back(Json{{"triangles", {pair.first, pair.second}}, {"position", place_json(pair.position)}});
  }
  return list;
}

Json manifold_json(const ManifoldCheck& check) {
  return Json{{"pass", check.pass},
              {"non_manifold_edges", check.non_manifold_edges},
              {"non_manifold_vertices", check.non_manifold_vertices},
              {"repeated_vertices", check.repeated_vertices},
              {"duplicate_triangles", check.duplicate_triangles},
              {"zero_area_triangles", check.zero_area_triangles},
              {"unreferenced_vertices", check.unreferenced_vertices},
              {"components", check.components},
              {"euler_characteristic", check.euler_characteristic},
              {"boundary_loops", check.boundary_loops}};
}

std::string figure_text(const Json& figure) {
  if (figure.is_number_float()) return number_text(figure.get<double>());
  return figure.is_string() ? figure.get<std::string>() : figure.dump();
}

// The result of a check; failures of some checks are reported without counting against the mesh.
std::string_view result_text(std::string_view check, bool pass) {
  if (pass) return "pass";
  return check == "normals" || check == "delaunay_balls" ? "noted" : "fail";
}

}  // namespace

Json checks_json(const Verification& v) {
  Json topology = certificate_json(v.topology);
  topology["pass"] = v.topology.verdict == Verdict::kHomeomorphic;
  return Json{{"manifold", manifold_json(v.manifold)},
              {"orientation",
               {{"pass", v.orientation.pass},
                {"misoriented_edges", v.orientation.misoriented_edges},
                {"reversed_components", v.orientation.reversed_components},
                {"reversed_at", places_json(v.orientation.reversed_at)}}},
              {"boundary",
               {{"pass", v.boundary.pass},
                {"boundary_edges", v.boundary.boundary_edges},
                {"off_box_edges", v.boundary.off_box_edges},
                {"outside_vertices", v.boundary.outside_vertices}}},
              {"topology", topology},
              {"self_intersection",
               {{"pass", v.self_intersection.pass},
                {"crossing_pairs", v.self_intersection.found.crossing_pairs},
                {"touching_pairs", v.self_intersection.found.touching_pairs},
                {"first_crossing", pairs_json(v.self_intersection.found.crossing)},
                {"first_touching", pairs_json(v.self_intersection.found.touching)}}},
              {"residual", {{"pass", v.residual.pass}, {"distance", distance_json(v.residual.distance)}}},
              {"distance",
               {{"pass", v.distance.pass},
                {"mesh_to_isosurface", distance_json(v.distance.mesh_to_isosurface)},
                {"isosurface_to_mesh", distance_json(v.distance.isosurface_to_mesh)}}},
              {"normals",
               {{"pass", v.normals.pass},
                {"against", v.normals.against},
                {"fraction_against", v.normals.fraction_against},
                {"min_cosine", v.normals.min_cosine},
                {"mean_cosine", v.normals.mean_cosine}}},
              {"delaunay_balls",
               {{"pass", v.delaunay_balls.pass},
                {"occupied", v.delaunay_balls.occupied},
                {"without_hit", v.delaunay_balls.without_hit}}}};
}

void print_checks(const Json& report, std::ostream& stream) {
  TextTable table;
  table.row({"check", "figure", "value", "result"});
  for (const auto& [check, figures] : report["checks"].items()) {
    table.row({check, "", "", std::string(result_text(check, figures["pass"].get<bool>()))});
    for (const auto& [name, figure] : figures.items()) {
      if (name == "pass" || figure.is_array()) continue;
      if (!figure.is_object()) table.row({"", name, figure_text(figure), ""});
      if (figure.is_object()) table.row({"", name + ".max_voxels", figure_text(figure["max_voxels"]), ""});
      if (figure.is_object()) table.row({"", name + ".mean_voxels", figure_text(figure["mean_voxels"]), ""});
    }
  }
  for (const auto& [name, figure] : report["quality"].items()) {
    if (!figure.is_array()) table.row({"quality", name, figure_text(figure), ""});
  }
  table.print(stream, true);
}

}  // namespace deliso
