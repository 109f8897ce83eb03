#include "experiments/commands/mesh_info.h"

#include <algorithm>
#include <iostream>
#include <numeric>

#include "delaunay/base/check.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/standard_input.h"
#include "experiments/system/text_table.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/mesh/mesh_topology.h"
#include "volume/io/base/input_file.h"

namespace deliso {
namespace {

MeshFile load_mesh(const std::string& path, const MeshFormatOptions& format) {
  MeshFile file = read_mesh_input(path, format);
  if (const std::size_t bad = first_bad_triangle(file.mesh); bad < file.mesh.triangles.size())
    throw InputError(path + ": triangle " + std::to_string(bad) + " names a vertex that is not there");
  return file;
}

Json mesh_info_report(const std::string& path, const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  const MeshTopology topology = mesh_topology(mesh);
  std::int64_t euler = 0, loops = 0;
  for (const MeshComponent& component : topology.components) {
    euler += component.euler_characteristic();
    loops += component.boundary_loops;
  }
  return Json{{"schema", "deliso-mesh-info-1"},
              {"program", program_json()},
              {"mesh", path},
              {"format", name_of(file.format)},
              {"comments", file.comments},
              {"vertices", mesh.points.size()},
              {"triangles", mesh.triangles.size()},
              {"components", topology.components.size()},
              {"euler_characteristic", euler},
              {"boundary_loops", loops},
              {"closed", topology.is_manifold() && loops == 0 && !mesh.triangles.empty()},
              {"manifold", topology.is_manifold()},
              {"oriented", topology.is_oriented()},
              {"non_manifold_edges", topology.non_manifold_edges},
              {"non_manifold_vertices", topology.non_manifold_vertices},
              {"misoriented_edges", topology.misoriented_edges},
              {"repeated_vertices", topology.repeated_vertices},
              {"unreferenced_vertices", topology.unreferenced_vertices},
              {"surface", surface_json(mesh, 1)},
              {"quality", quality_json(measure_quality(mesh))}};
}

std::string volume_text(const Json& volume) { return volume.is_null() ? "none" : number_text(volume.get<double>()); }

std::string point_text(const Json& point) {
  return number_text(point[0].get<double>()) + " " + number_text(point[1].get<double>()) + " " +
         number_text(point[2].get<double>());
}

std::string whole_text(const Json& number) { return std::to_string(number.get<std::int64_t>()); }

std::string yes_or_no(const Json& value) { return value.get<bool>() ? "yes" : "no"; }

// What speaks against a manifold or an orientation, where anything does.
void print_mesh_faults(const Json& report, TextTable& table) {
  for (const char* key : {"non_manifold_edges", "non_manifold_vertices", "misoriented_edges", "repeated_vertices",
                          "unreferenced_vertices"}) {
    if (report[key].get<std::int64_t>() == 0) continue;
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    table.row({name, whole_text(report[key])});
  }
}

// The largest first.
void print_mesh_components(const Json& components) {
  constexpr std::size_t kShown = 10;
  if (components.size() < 2) return;
  std::vector<std::size_t> order(components.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return components[a]["area"].get<double>() > components[b]["area"].get<double>();
  });
  TextTable table;
  table.row({"component", "vertices", "euler characteristic", "boundary loops", "area", "enclosed volume"});
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i) {
    const Json& c = components[order[i]];
    table.row({whole_text(c["component"]), whole_text(c["vertices"]), whole_text(c["euler_characteristic"]),
               whole_text(c["boundary_loops"]), number_text(c["area"].get<double>()),
               volume_text(c["enclosed_volume"])});
  }
  std::cout << '\n';
  table.print(std::cout, true);
  if (order.size() > kShown) std::cout << order.size() - kShown << " smaller components stand in the report\n";
}

void print_mesh_info(const Json& report) {
  const Json& surface = report["surface"];
  const Json& quality = report["quality"];
  TextTable table;
  table.row({"format", report["format"].get<std::string>()})
      .row({"vertices", whole_text(report["vertices"])})
      .row({"triangles", whole_text(report["triangles"])})
      .row({"components", whole_text(report["components"])})
      .row({"euler characteristic", whole_text(report["euler_characteristic"])})
      .row({"boundary loops", whole_text(report["boundary_loops"])})
      .row({"closed", yes_or_no(report["closed"])})
      .row({"manifold", yes_or_no(report["manifold"])})
      .row({"oriented", yes_or_no(report["oriented"])});
  print_mesh_faults(report, table);
  if (surface.contains("area")) {
    table.row({"area", number_text(surface["area"].get<double>())})
        .row({"enclosed volume", volume_text(surface["enclosed_volume"])})
        .row({"box", point_text(surface["box"]["low"]) + "  to  " + point_text(surface["box"]["high"])})
        .row({"min angle (degrees)", number_text(quality["min_angle_degrees"].get<double>())})
        .row({"max angle (degrees)", number_text(quality["max_angle_degrees"].get<double>())});
  }
  for (const Json& comment : report["comments"]) table.row({"comment", comment.get<std::string>()});
  table.print(std::cout);
  print_mesh_components(surface["components"]);
}

}  // namespace

bool is_mesh_input(const std::string& path, const MeshFormatOptions& format) {
  if (!format.format.empty()) return true;
  if (is_standard_stream(path)) return is_mesh_content(standard_input_file());
  if (is_packed_mesh_path(path)) return true;  // reading it says what is wrong
  const std::optional<MeshFormat> known = mesh_format_of(path);
  if (known && *known != MeshFormat::kLegacyVtk) return true;
  const bool may_be = known || lower_case_extension(path).empty();
  return may_be && is_mesh_content(path);
}

ExitCode run_mesh_info(const std::string& path, const MeshFormatOptions& format, const std::string& report_path,
                       bool json) {
  const Json report = mesh_info_report(path, load_mesh(path, format));
  if (!report_path.empty()) write_text(json_text(report), report_path);
  if (is_standard_stream(report_path)) return ExitCode::kDone;  // the JSON stands there already
  if (json) {
    std::cout << json_text(report);
  } else {
    print_mesh_info(report);
  }
  return ExitCode::kDone;
}

}  // namespace deliso
