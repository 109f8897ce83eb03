#include "experiments/commands/verify_report.h"

#include <string>
#include <string_view>

#include "experiments/runs/record.h"
#include "experiments/system/text_table.h"
#include "surface/library/verification_report.h"

namespace deliso {
namespace {

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

Json checks_json(const Verification& v) { return json_of(checks_tree(v)); }

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
