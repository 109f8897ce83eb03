#include "experiments/commands/world.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string_view>
#include <system_error>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/program_info.h"
#include "surface/library/mesh_notes.h"

namespace deliso {
namespace {

// What begins a line of a mesh file's comments.
constexpr std::string_view kSpace = "space", kLocalOrigin = "local origin";

Json point_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

Json name_json(const std::string& name) { return name.empty() ? Json() : Json(name); }

std::string or_unknown(const std::string& name) { return name.empty() ? "unknown" : name; }

// Units of the world in a millimetre; none where the name is not known.
std::optional<double> units_in_a_millimetre(const std::string& units) {
  // The micro sign and the Greek letter look alike.
  static constexpr std::array<std::pair<std::string_view, double>, 29> kUnits{{{"mm", 1},
                                                                               {"millimeter", 1},
                                                                               {"millimeters", 1},
                                                                               {"millimetre", 1},
                                                                               {"millimetres", 1},
                                                                               {"m", 1e-3},
                                                                               {"meter", 1e-3},
                                                                               {"meters", 1e-3},
                                                                               {"metre", 1e-3},
                                                                               {"metres", 1e-3},
                                                                               {"cm", 0.1},
                                                                               {"centimeter", 0.1},
                                                                               {"centimeters", 0.1},
                                                                               {"km", 1e-6},
                                                                               {"um", 1e3},
                                                                               {"\u00b5m", 1e3},
                                                                               {"\u03bcm", 1e3},
                                                                               {"micron", 1e3},
                                                                               {"microns", 1e3},
                                                                               {"micrometer", 1e3},
                                                                               {"micrometers", 1e3},
                                                                               {"micrometre", 1e3},
                                                                               {"micrometres", 1e3},
                                                                               {"nm", 1e6},
                                                                               {"angstrom", 1e7},
                                                                               {"angstroms", 1e7},
                                                                               {"inch", 1 / 25.4},
                                                                               {"inches", 1 / 25.4},
                                                                               {"in", 1 / 25.4}}};
  for (const auto& [name, in_a_millimetre] : kUnits) {
    if (name == units) return in_a_millimetre;
  }
  return std::nullopt;
}

// Where the file names no units, those of the world are taken for millimetres (print_units_remark).
double millimetre_of(const Volume& volume, const std::string& option) {
  const std::string& units = volume.placement.units;
  if (units.empty()) return 1;
  if (const std::optional<double> unit = units_in_a_millimetre(units)) return *unit;
  throw InputError(option + ": a length in mm needs units that are known, the volume's are " + in_quotes(units) +
                   ", expected mm, um, inch or the like; give it in units of the world with w, as in 0.5w, or in "
                   "voxels, as in 0.5");
}

// A stated length and a spacing are decimals, each rounded to a double: what their quotient has behind 15 digits comes
// of that, and 0.0855 mm of 0.57 mm are 0.15.
double without_rounding(double quotient) {
  constexpr int kDigits = 15;
  std::array<char, 32> text{};
  char* const end = text.data() + text.size();
  std::from_chars(text.data(), std::to_chars(text.data(), end, quotient, std::chars_format::general, kDigits).ptr,
                  quotient);
  return quotient;
}

bool is_in_millimetres(std::string_view text) {
  return text.ends_with("mm") || text.ends_with("mm2") || text.ends_with("mm3");
}

}  // namespace

void add_world_options(Command& command, WorldOptions& options) {
  const std::string by_default = options.space.empty() ? " (default: what the mesh file says, or native)" : "";
  CommandOption option =
      command
          .add_option("--space", options.space,
                      "World coordinates of the mesh: native (as in the volume's file), LPS or RAS" + by_default)
          .type_name("SPACE")
          .check(refuse_empty_value);
  if (by_default.empty()) option.show_default();
  command.add_flag("--local-origin", options.local_origin,
                   "Coordinates of the mesh count from the first sample (for STL far from the origin)");
}

void check_space(const std::string& space) {
  if (space.empty() || space == "native" || space == "LPS" || space == "RAS" || space == "lps" || space == "ras")
    return;
  throw InputError("--space: expected native, LPS or RAS, found '" + space + "'");
}

void take_world_notes(const std::vector<std::string>& comments, const Volume& volume, WorldOptions& options) {
  if (options.space.empty()) {
    const std::string text = note_in(comments, kSpace).value_or("");
    const std::string space = text.substr(0, text.find(','));
    options.space = "native";
    for (const char* const known : {"LPS", "RAS"}) {
      if (space == space_name(known) && !volume.placement.space.empty()) options.space = known;
    }
  }
  if (note_in(comments, kLocalOrigin)) options.local_origin = true;
}

World world_of(const Volume& volume, const WorldOptions& options) {
  check_space(options.space);
  // Between spaces of anatomy x and y change their signs, those of the grid's own coordinates included.
  const Placement placement = in_space(volume.placement, options.space);
  World world{placement.to_world, placement.space, placement.units, std::nullopt, placement.is_sheared()};
  if (!options.local_origin) return world;
  world.local_origin = placement.to_world(volume.whole_origin.value_or(volume.grid.origin()));
  world.from_grid.offset = placement.to_world.offset - *world.local_origin;
  return world;
}

double parse_length(const std::string& text, const std::string& option, const Volume* volume) {
  const bool in_millimetres = text.ends_with("mm"), in_world = text.ends_with("w");
  const std::string expected = "a finite number: of voxels, or like 0.5mm, or 0.5w in the volume's own units";
  if (!in_millimetres && !in_world) return parse_number(text, option, text, expected);
  const std::string number = text.substr(0, text.size() - (in_millimetres ? 2 : 1));
  const double length = parse_number(number, option, text, expected);
  if (volume == nullptr) return length > 0 ? 1 : length < 0 ? -1 : 0;
  const Vec3& s = volume->grid.spacing();
  const double unit = in_millimetres ? millimetre_of(*volume, option) : 1;
  const double voxels = without_rounding(length * unit / std::min({s.x, s.y, s.z}));
  if (!std::isfinite(voxels)) throw InputError(option + ": expected " + expected + ", found '" + text + "'");
  return voxels;
}

std::string with_length_in_voxels(const std::string& assignment, const Volume* volume) {
  constexpr std::array<std::string_view, 7> kLengths{
      "stage1.size_bound_voxels", "stage2.max_distance", "stage2.h_min", "promise.max_distance", "field.smooth",
      "size.max_error",           "size.max_edge"};
  const std::size_t equals = assignment.find('=');
  const std::string key = assignment.substr(0, equals);
  if (equals == std::string::npos || std::find(kLengths.begin(), kLengths.end(), key) == kLengths.end())
    return assignment;
  const std::string value = assignment.substr(equals + 1);
  if (!value.ends_with("mm") && !value.ends_with("w")) return assignment;
  return key + "=" + shortest_text(parse_length(value, "--set " + key, volume));
}

void print_units_remark(const std::string& path, const Volume& volume, const std::vector<std::string>& lengths) {
  if (!volume.placement.units.empty() || !std::any_of(lengths.begin(), lengths.end(), is_in_millimetres)) return;
  std::cerr << "deliso: " << path
            << ": the file names no units of its space; units of its world are taken for millimetres\n";
}

std::vector<std::string> mesh_comments(const std::string& volume_path, const std::string& sha256, double isovalue,
                                       const World& world, const std::vector<std::string>& notes) {
  std::vector<std::string> lines;
  lines.push_back("DelIso " + program_info().version + ", isovalue " + shortest_text(isovalue));
  lines.insert(lines.end(), notes.begin(), notes.end());
  lines.push_back(std::string(kSpace) + " " + or_unknown(world.space) + ", units " + or_unknown(world.units));
  if (world.local_origin) {
    const Vec3& o = *world.local_origin;
    lines.push_back(std::string(kLocalOrigin) + " " + shortest_text(o.x) + " " + shortest_text(o.y) + " " +
                    shortest_text(o.z) + ", to be added to every vertex");
  }
  const std::string file = std::filesystem::path(volume_path).filename().string();
  lines.push_back("volume " + (file == "-" ? "of standard input" : on_one_line(file)));
  lines.push_back("samples sha256 " + sha256);
  return lines;
}

std::optional<std::string> note_in(const std::vector<std::string>& comments, std::string_view key) {
  for (const std::string& comment : comments) {
    if (comment.starts_with(key) && comment.size() > key.size() && comment[key.size()] == ' ')
      return comment.substr(key.size() + 1);
  }
  return std::nullopt;
}

std::optional<double> promised_distance(const std::vector<std::string>& comments) {
  const std::string text = note_in(comments, kPromiseNote).value_or("");
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && value > 0 && std::isfinite(value)) return value;
  return std::nullopt;
}

std::optional<double> metres_in_unit(const std::string& units) {
  const std::optional<double> unit = units_in_a_millimetre(units);
  return unit ? std::optional(1e-3 / *unit) : std::nullopt;
}

Json source_json(const Volume& volume) {
  const auto& [x, y, z] = volume.index_to_world.columns;
  Json rows = Json::array();
  for (std::size_t row = 0; row < 3; ++row) {
    // Plus 0: a zero of a file may be -0.
    rows.push_back(Json::array({x[row] + 0, y[row] + 0, z[row] + 0, volume.index_to_world.offset[row] + 0}));
  }
  return Json{{"format", volume.format},
              {"stored_type", volume.stored_type},
              {"channels", volume.channels},
              {"channel", volume.channel},
              {"space", name_json(volume.placement.space)},
              {"units", name_json(volume.placement.units)},
              {"index_to_world", rows}};
}

Json world_json(const World& world) {
  return Json{{"space", name_json(world.space)},
              {"units", name_json(world.units)},
              {"local_origin", world.local_origin ? point_json(*world.local_origin) : Json()},
              {"lengths", world.is_sheared ? "before the shear" : "world"}};
}

std::string shear_remark(const World& world) {
  if (!world.is_sheared) return "";
  return "the volume's axes are not perpendicular: it is meshed as if they were, and sheared afterwards; distances and "
         "angles are those before the shear";
}

}  // namespace deliso
