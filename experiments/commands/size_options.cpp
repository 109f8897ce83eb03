#include "experiments/commands/size_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <system_error>

#include "delaunay/base/check.h"
#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/config/config.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"
#include "surface/base/sizes.h"
#include "surface/library/mesh_notes.h"
#include "volume/region.h"

namespace deliso {
namespace {

double length_of_at_least(double least, const std::string& text, const std::string& option, const Volume* volume) {
  const double length = parse_length(text, option, volume);
  if (!(length > 0))
    throw InputError(option + ": expected a length > 0, in voxels or like 0.5mm, found '" + text + "'");
  if (length >= least) return length;
  throw InputError(option + ": expected a length of " + shortest_text(least) + " voxels or more, found '" + text +
                   "', which is " + shortest_text(length) + " voxels");
}

// With the checks of the parameter that the option sets; what is wrong is said of the option.
void set_number(const std::string& text, const std::string& option, std::string_view key, Parameters& parameters) {
  if (text.empty()) return;
  set_parameter(key, typed_value(text), option, parameters);
}

// "50", "area:2.5", "volume:10mm3": vertices, or a measure in voxels to its power, or in units of the world.
void set_least_component(const std::string& text, const Volume* volume, Parameters& parameters) {
  const std::string option = "--min-component";
  const std::size_t colon = text.find(':');
  const std::string kind = colon == std::string::npos ? "vertices" : text.substr(0, colon);
  const std::string value = colon == std::string::npos ? text : text.substr(colon + 1);
  if (kind == "vertices") {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
    parameters.components.min_vertices = static_cast<std::int64_t>(parse_count(value, option, 1, kMost));
    return;
  }
  if (kind != "area" && kind != "volume") {
    throw InputError(option + ": expected a number of vertices, area:A or volume:V, found '" + text + "'");
  }
  const int power = kind == "area" ? 2 : 3;
  const std::string suffix = std::to_string(power);
  std::string number = value;
  double unit = 1;
  for (const std::string name : {"mm", "w"}) {
    if (!number.ends_with(name + suffix)) continue;
    number.resize(number.size() - name.size() - suffix.size());
    unit = std::pow(parse_length("1" + name, option, volume), power);
    break;
  }
  const std::string expected =
      "a finite number: of voxels, or like 5mm" + suffix + ", or 5w" + suffix + " in the volume's own units";
  const double measure = unit * parse_number(number, option, text, expected);
  if (!(measure > 0)) throw InputError(option + ": expected a number > 0, found '" + text + "'");
  (power == 2 ? parameters.components.min_area : parameters.components.min_volume) = measure;
}

void set_region(const std::string& text, Parameters& parameters) {
  const SampleRegion region = parse_region(text, "--region");
  parameters.region = {region.first[0], region.last[0],  region.first[1],
                       region.last[1],  region.first[2], region.last[2]};
}

std::string cause_text(DropCause cause) {
  if (cause == DropCause::kCavity) return "in cavities";
  return cause == DropCause::kSmall ? "too small" : "not among the largest";
}

}  // namespace

void add_size_options(Command& command, SizeOptions& options) {
  const auto add = [&](const std::string& name, std::string& value, const std::string& help, const std::string& type) {
    command.add_option(name, value, help).type_name(type).check(refuse_empty_value);
  };
  add("--max-error", options.max_error,
      "Mesh and isosurface within D of each other, with as few vertices as that allows: voxels, or like 0.5mm", "D");
  add("--max-edge", options.max_edge, "No edge longer than D, as far as insertions allow", "D");
  add("--min-angle", options.min_angle, "No angle below A degrees, as far as that can be (at most 35)", "A");
  add("--max-aspect", options.max_aspect,
      "No longest edge over smallest height above Q, as far as that can be (at least 3)", "Q");
  add("--target-vertices", options.target_vertices, "So many vertices, within 2 %, at the least error", "N");
  add("--keep-largest", options.keep_largest, "Keep the N components of the largest area", "N");
  add("--min-component", options.min_component,
      "Leave out components below V: 50 (vertices), area:2.5, volume:10 (voxels), area:2mm2, volume:5mm3", "V");
  command.add_flag("--fill-cavities", options.fill_cavities,
                   "Leave out closed components that bound cavities of solids, of what is inside");
  add("--region", options.region, "Mesh the samples i0:i1,j0:j1,k0:k1 alone, the last ones included", "R");
}

void apply_size_options(const SizeOptions& options, const Volume* volume, Parameters& parameters) {
  if (!options.max_error.empty()) {
    parameters.size.max_error = length_of_at_least(kLeastDistance, options.max_error, "--max-error", volume);
  }
  if (!options.max_edge.empty()) {
    parameters.size.max_edge = length_of_at_least(kLeastMaxEdge, options.max_edge, "--max-edge", volume);
  }
  set_number(options.min_angle, "--min-angle", "size.min_angle", parameters);
  set_number(options.max_aspect, "--max-aspect", "size.max_aspect", parameters);
  set_number(options.target_vertices, "--target-vertices", "size.target_vertices", parameters);
  set_number(options.keep_largest, "--keep-largest", "components.keep_largest", parameters);
  if (!options.min_component.empty()) set_least_component(options.min_component, volume, parameters);
  if (options.fill_cavities) parameters.components.fill_cavities = true;
  if (!options.region.empty()) set_region(options.region, parameters);
}

KeptInFile kept_in_file(const std::vector<std::string>& comments) {
  const std::string of_dropped = note_line(kDroppedNote, ""), of_region = note_line(kRegionNote, "");
  KeptInFile kept;
  for (const std::string& comment : comments) {
    if (comment.starts_with(of_dropped)) {
      std::int64_t count = 0;
      const char* const number = comment.data() + of_dropped.size();
      const auto error = std::from_chars(number, comment.data() + comment.size(), count).ec;
      if (error == std::errc() && count > 0) kept.dropped = count;
    }
    if (comment == note_line(kSpacingNote, "ignore")) kept.ignores_spacing = true;
    if (!comment.starts_with(of_region)) continue;
    const std::string text = comment.substr(of_region.size());
    const bool is_one = text.find_first_not_of("0123456789:,") == std::string::npos &&
                        std::count(text.begin(), text.end(), ':') == 3 &&
                        std::count(text.begin(), text.end(), ',') == 2;
    if (is_one) kept.region = text;
  }
  return kept;
}

std::vector<std::string> size_remarks(const Parameters& parameters, const MeshingResult& result) {
  std::vector<std::string> remarks;
  for (const DropCause cause : {DropCause::kCavity, DropCause::kSmall, DropCause::kNotLargest}) {
    std::int64_t count = 0, vertices = 0;
    double area = 0;
    for (const DroppedPiece& dropped : result.dropped) {
      if (dropped.cause != cause) continue;
      ++count;
      vertices += dropped.piece.vertices;
      area = std::max(area, dropped.piece.area);
    }
    if (count == 0) continue;
    remarks.push_back("left out: " + counted(count, "component", "components") + " " + cause_text(cause) + ", with " +
                      counted(vertices, "vertex", "vertices") + "; the largest has an area of " + number_text(area) +
                      " voxels^2");
  }
  const auto& target = parameters.size.target_vertices;
  if (target && !parameters.size.max_error && result.promised_distance > parameters.promise.max_distance) {
    remarks.push_back("--target-vertices: so few vertices take a distance of " + number_text(result.promised_distance) +
                      " voxels between mesh and isosurface, which the mesh file promises");
  }
  return remarks;
}

}  // namespace deliso
