#include "experiments/commands/mesh_output.h"

#include <iostream>
#include <utility>

#include "delaunay/base/check.h"
#include "experiments/system/files.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/standard_input.h"
#include "surface/mesh/component_measures.h"
#include "surface/mesh/mesh_topology.h"
#include "volume/io/base/input_file.h"

namespace deliso {
namespace {

constexpr std::string_view kFormatNames = "ply, off, obj, stl, mesh, msh, smesh, vtk, vtp or glb";
constexpr std::string_view kReadFormatNames = "ply, off, obj, stl, mesh, vtk or vtp";

std::optional<MeshFormat> typed_format(const MeshFormatOptions& options, std::string_view expected) {
  if (options.format.empty()) return std::nullopt;
  const std::optional<MeshFormat> format = mesh_format_named(options.format);
  if (!format) throw InputError("--format: expected " + std::string(expected) + ", found '" + options.format + "'");
  return format;
}

Json box_json(const Box3& box) {
  return Json{{"low", {box.low.x, box.low.y, box.low.z}}, {"high", {box.high.x, box.high.y, box.high.z}}};
}

Json measure_json(const ComponentMeasure& measure) {
  return Json{{"area", measure.area},
              {"enclosed_volume", measure.enclosed_volume ? Json(*measure.enclosed_volume) : Json()},
              {"box", box_json(measure.box)}};
}

MeshFile read_file_or_stream(const std::string& path, std::optional<MeshFormat> format) {
  if (!is_standard_stream(path)) return read_mesh_file(path, format);
  const std::string bytes = read_text(standard_input_file());
  const std::optional<MeshFormat> found = format ? format : mesh_format_of_content(bytes, bytes.size());
  if (!found)
    throw InputError("standard input: its beginning tells no format of meshes, expected --format " +
                     std::string(kReadFormatNames));
  return parse_mesh(bytes, *found, "standard input");
}

}  // namespace

void add_mesh_output_options(Command& command, MeshFormatOptions& options) {
  command
      .add_option(
          "--format", options.format,
          "Format of the mesh: " + std::string(kFormatNames) + " (default: by the extension; to standard output: ply)")
      .type_name("F")
      .check(refuse_empty_value);
  command.add_option("--msh-version", options.gmsh_version, "Version of Gmsh's format: 4.1 or 2.2")
      .type_name("V")
      .show_default();
}

void add_mesh_input_option(Command& command, MeshFormatOptions& options) {
  command
      .add_option("--format", options.format,
                  "Format of the mesh: " + std::string(kReadFormatNames) + " (default: by extension or content)")
      .type_name("F")
      .check(refuse_empty_value);
}

MeshFormat output_format(const std::string& path, const std::string& option, const MeshFormatOptions& options) {
  if (const auto format = typed_format(options, kFormatNames)) return *format;
  if (is_standard_stream(path)) return MeshFormat::kPly;
  const std::optional<MeshFormat> format = mesh_format_of(path);
  if (!format)
    throw InputError(option + ": a mesh file ends in " + std::string(kMeshExtensions) + ", found '" + path + "'");
  return *format;
}

void check_mesh_output(const std::string& path, const std::string& option, const MeshFormatOptions& options) {
  static_cast<void>(output_format(path, option, options));
  if (options.gmsh_version != "4.1" && options.gmsh_version != "2.2")
    throw InputError("--msh-version: expected 4.1 or 2.2, found '" + options.gmsh_version + "'");
  if (!is_standard_stream(path)) check_replaceable(path, option);
}

GmshVersion gmsh_version(const MeshFormatOptions& options) {
  return options.gmsh_version == "2.2" ? GmshVersion::k2 : GmshVersion::k4;
}

std::string write_mesh_output(const TriangleMesh& mesh, const std::string& path, MeshFileOptions options) {
  const bool is_stream = is_standard_stream(path);
  if (!options.format) options.format = is_stream ? MeshFormat::kPly : mesh_format_of(path);
  std::string options_needed;
  if (options.format == MeshFormat::kStl && !options.ascii) {
    StlNotes notes = short_stl_notes(options.comments);
    options.comments = std::move(notes.comments);
    options_needed = std::move(notes.options_needed);
  }
  if (is_stream) {
    std::cout << mesh_bytes(mesh, *options.format, options, "standard output");
  } else {
    write_mesh(mesh, path, options);
  }
  return options_needed;
}

MeshFile read_mesh_input(const std::string& path, const MeshFormatOptions& options) {
  MeshFile file = read_file_or_stream(path, typed_format(options, kReadFormatNames));
  if (file.format == MeshFormat::kStl) file.comments = long_stl_notes(file.comments);
  return file;
}

Json surface_json(const TriangleMesh& mesh, int threads) {
  const MeshTopology topology = mesh_topology(mesh, threads);
  const std::vector<ComponentMeasure> measures = component_measures(mesh, topology);
  Json json = measures.empty() ? Json::object() : measure_json(whole_measure(measures));
  Json& components = json["components"] = Json::array();
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const MeshComponent& component = topology.components[i];
    Json entry{{"component", i + 1},
               {"vertices", component.vertices},
               {"triangles", component.triangles},
               {"euler_characteristic", component.euler_characteristic()},
               {"boundary_loops", component.boundary_loops}};
    entry.update(measure_json(measures[i]));
    components.push_back(std::move(entry));
  }
  return json;
}

}  // namespace deliso
