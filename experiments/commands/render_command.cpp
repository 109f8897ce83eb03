// deliso render: pictures of isosurfaces by ray casting, and of meshes with their edges.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/stopwatch.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/mesh_output.h"
#include "experiments/commands/world.h"
#include "experiments/pictures/isosurface_shape.h"
#include "experiments/pictures/mesh_shape.h"
#include "experiments/pictures/picture.h"
#include "experiments/pictures/placed_shape.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/progress_bar.h"
#include "experiments/system/text_table.h"
#include "surface/intersection/exact_tests.h"
#include "surface/mesh/mesh_frame.h"
#include "volume/marching_cubes/marching_cubes.h"
#include "volume/regular_isovalue.h"

namespace deliso {
namespace {

struct RenderCommandOptions {
  VolumeOptions volume;
  FieldOptions field;
  std::string output;
  std::vector<std::string> meshes;
  WorldOptions world{.space = ""};  // of the meshes
  bool surface = false;
  bool marching_cubes = false;
  bool closed = false;
  std::vector<std::string> clips;
  std::string view = "30,20";
  std::string zoom = "1";
  std::string look_at;
  std::string field_of_view = "0";
  std::string size;
  std::string samples = "3";
  std::string line_width = "1.1";
  std::string threads;
};

// One part of the picture, from left to right.
struct Panel {
  std::string name;
  std::unique_ptr<Shape> shape;
  const TriangleMesh* mesh = nullptr;  // the shape's, if it has one
  bool is_seen = false;                // once it is drawn
};

constexpr std::int32_t kLargestSide = 16384;
constexpr std::int32_t kMostSamples = 8;
constexpr std::int64_t kMostRays = std::int64_t{1} << 26;  // all rays of a panel are kept in memory until it is drawn

double number_in(const std::string& text, const std::string& option, double low, double high) {
  const double value = parse_number(text, option);
  if (value >= low && value <= high) return value;
  throw InputError(option + ": expected a number from " + number_text(low) + " to " + number_text(high) + ", found '" +
                   text + "'");
}

// "a<separator>b<separator>c" as its parts.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

View parse_view(const RenderCommandOptions& options) {
  View view;
  const std::vector<std::string> angles = parts_of(options.view, ',');
  if (angles.size() != 2) {
    throw InputError("--view: expected AZIMUTH,ELEVATION in degrees, found '" + options.view + "'");
  }
  view.azimuth = number_in(angles[0], "--view", -360, 360);
  view.elevation = number_in(angles[1], "--view", -90, 90);
  view.zoom = number_in(options.zoom, "--zoom", 1e-3, 1e6);
  view.field_of_view = number_in(options.field_of_view, "--perspective", 0, 150);
  if (options.look_at.empty()) return view;
  const std::vector<std::string> coordinates = parts_of(options.look_at, ',');
  if (coordinates.size() != 3) throw InputError("--look-at: expected X,Y,Z, found '" + options.look_at + "'");
  view.look_at.emplace();
  for (std::size_t a = 0; a < 3; ++a) (*view.look_at)[a] = parse_number(coordinates[a], "--look-at", options.look_at);
  return view;
}

// The whole picture's, white.
Image empty_image(const RenderCommandOptions& options, std::int32_t panels, std::int32_t samples) {
  if (options.size.empty()) return {panels == 1 ? 800 : 600 * panels, 600};
  const std::vector<std::string> sides = parts_of(options.size, 'x');
  if (sides.size() != 2) throw InputError("--size: expected WIDTHxHEIGHT in pixels, found '" + options.size + "'");
  const auto side = [](const std::string& text, std::int32_t low) {
    return static_cast<std::int32_t>(parse_count(text, "--size", static_cast<std::uint64_t>(low), kLargestSide));
  };
  const std::int32_t width = side(sides[0], panels);
  const std::int32_t height = side(sides[1], 1);
  const std::int64_t rays = std::int64_t{width} * height / panels * samples * samples;
  if (rays > kMostRays) {
    throw InputError("--size: " + options.size + " with --samples " + std::to_string(samples) + " needs " +
                     std::to_string(rays) + " rays, the most is " + std::to_string(kMostRays));
  }
  return {width, height};
}

PictureOptions parse_picture_options(const RenderCommandOptions& options) {
  PictureOptions picture;
  picture.samples = static_cast<std::int32_t>(parse_count(options.samples, "--samples", 1, kMostSamples));
  picture.line_width = number_in(options.line_width, "--line-width", 0, 100);
  picture.threads = options.threads.empty()
                        ? static_cast<std::int32_t>(std::max(1u, std::thread::hardware_concurrency()))
                        : parse_threads(options.threads);
  return picture;
}

Panel mesh_panel(const std::string& name, TriangleMesh mesh) {
  if (mesh.triangles.empty()) throw InputError(name + ": the mesh has no triangle, nothing can be drawn");
  auto shape = std::make_unique<MeshShape>(std::move(mesh));
  const TriangleMesh* drawn = &shape->mesh();
  return {name, std::move(shape), drawn};
}

// A mesh in the volume's own world coordinates, whatever the space and origin of its file.
TriangleMesh mesh_in_world(const std::string& path, const Volume& volume, WorldOptions options) {
  MeshFile file = read_mesh_input(path, {});
  take_world_notes(file.comments, volume, options);
  const Affine from_grid = world_of(volume, options).from_grid;
  const Affine& to_world = volume.placement.to_world;
  if (from_grid == to_world) return std::move(file.mesh);
  return transformed(std::move(file.mesh), composed(to_world, from_grid.inverse()));
}

// First the ray-cast surface (when it is asked for, or nothing else is), then marching cubes, then the meshes; all in
// the volume's world coordinates.
std::vector<Panel> make_panels(const RenderCommandOptions& options, std::unique_ptr<IsosurfaceShape> surface,
                               const ScalarGrid& grid, double isovalue, const Volume& volume) {
  const Placement& placement = volume.placement;
  std::vector<Panel> panels;
  if (options.surface || (options.meshes.empty() && !options.marching_cubes)) {
    std::unique_ptr<Shape> shape = std::move(surface);
    if (!placement.is_identity()) shape = std::make_unique<PlacedShape>(std::move(shape), placement.to_world);
    panels.push_back({"isosurface", std::move(shape), nullptr});
  }
  if (options.marching_cubes) {
    MarchingCubesMesh cubes = marching_cubes(grid, isovalue, &kExactTests);
    TriangleMesh mesh{std::move(cubes.points), std::move(cubes.triangles)};
    if (!placement.is_identity()) mesh = transformed(std::move(mesh), placement.to_world);
    panels.push_back(mesh_panel("marching cubes", std::move(mesh)));
  }
  for (const std::string& path : options.meshes) {
    panels.push_back(mesh_panel(path, mesh_in_world(path, volume, options.world)));
  }
  return panels;
}

// The middle of the picture and its scale are those of the isosurface: a mesh far from it would not be seen.
void remark_what_is_not_seen(const std::vector<Panel>& panels, const std::vector<Vec3>& framed) {
  Box3 surface;
  for (const Vec3& p : framed) surface.extend(p);
  for (const Panel& panel : panels) {
    const bool is_near = panel.mesh == nullptr || panel.shape->box().meets(surface);
    if (is_near && panel.is_seen) continue;
    std::cerr << "deliso: " << panel.name
              << (is_near ? ": nothing of it is in the picture, expected another --look-at, --view, --zoom or --clip\n"
                          : " lies outside the box of the isosurface (is its --space another one?)\n");
  }
}

void print_panels(const std::string& output, const Image& image, const std::vector<Panel>& panels, double seconds) {
  TextTable table;
  table.row({"picture", output});
  table.row({"size", std::to_string(image.width) + " x " + std::to_string(image.height)});
  for (const Panel& panel : panels) {
    table.row({panel.name, panel.mesh == nullptr ? "ray cast"
                                                 : std::to_string(panel.mesh->points.size()) + " vertices, " +
                                                       std::to_string(panel.mesh->triangles.size()) + " triangles"});
  }
  table.row({"seconds", number_text(seconds)});
  table.print(std::cout);
}

void check_mesh_options(const RenderCommandOptions& options) {
  check_space(options.world.space);
  if (options.meshes.empty() && (!options.world.space.empty() || options.world.local_origin))
    throw InputError("--space and --local-origin are for meshes, expected --mesh, too");
  std::vector<NamedFile> inputs = {{"VOLUME", options.volume.path}};
  for (const std::string& mesh : options.meshes) inputs.push_back({"--mesh", mesh});
  check_one_standard_input(inputs);
  check_distinct(inputs, {{"-o", options.output}});
}

ExitCode run_render(const RenderCommandOptions& options) {
  // Every option is checked before anything is read.
  check_field_options(options.field);
  const View view = parse_view(options);
  PictureOptions picture = parse_picture_options(options);
  std::vector<ClipPlane> clips;
  for (const std::string& clip : options.clips) clips.push_back(parse_clip_plane(clip, "--clip"));
  const bool alone = options.meshes.empty() && !options.marching_cubes;
  const auto panel_count = static_cast<std::int32_t>(options.meshes.size()) + (options.marching_cubes ? 1 : 0) +
                           (options.surface || alone ? 1 : 0);
  Image image = empty_image(options, panel_count, picture.samples);
  check_png_output(options.output, "-o");
  check_mesh_options(options);

  const Volume volume = load_volume(options.volume);
  check_apart_from_data(volume.data_files, {{"-o", options.output}});
  const FieldOfOptions field = field_of_options(options.volume.path, volume, options.field, options.closed);
  const ScalarGrid& grid = field.meshed.grid;
  const double used = regular_isovalue(grid, field.meshed.isovalue);
  const Stopwatch stopwatch;
  auto surface = std::make_unique<IsosurfaceShape>(grid, used);
  std::vector<Vec3> framed = surface->outermost_points();
  for (Vec3& p : framed) p = volume.placement.to_world(p);
  std::vector<Panel> panels = make_panels(options, std::move(surface), grid, used, volume);

  // All panels have the same camera and the same clip planes.
  const std::int32_t width = image.width / panel_count;
  const Camera camera(view, framed, width, image.height);
  Box3 whole = placed_box(grid.box(), volume.placement.to_world);
  for (const Panel& panel : panels) {
    whole.extend(panel.shape->box().low);
    whole.extend(panel.shape->box().high);
  }
  const Box3 kept = kept_box(whole, clips, camera.toward_eye(), "--clip");
  {
    ProgressBar bar(std::cerr, stderr_is_terminal());
    for (std::int32_t i = 0; i < panel_count; ++i) {
      Panel& panel = panels[static_cast<std::size_t>(i)];
      picture.progress = [&](double share) { bar.show((i + share) / panel_count, panel.name); };
      panel.is_seen = draw(*panel.shape, kept, camera, picture, i * width, image);
    }
  }
  write_png(image, options.output);
  print_panels(options.output, image, panels, stopwatch.seconds());
  for (const std::string& remark : field_remarks(volume, options.field, field.chosen)) {
    std::cerr << "deliso: " << remark << '\n';
  }
  print_units_remark(options.volume.path, volume, {options.field.smooth});
  remark_isovalue(&grid, field.chosen.isovalue, used);
  remark_what_is_not_seen(panels, framed);
  return ExitCode::kDone;
}

}  // namespace

void add_render_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<RenderCommandOptions>();
  Command command = line.add_command("render", "A picture of an isosurface by ray casting, or of meshes of it");
  add_volume_options(command, options->volume);
  add_region_option(command, options->volume);
  const auto add = [&command](const std::string& name, auto& value, const std::string& help, const std::string& type) {
    return command.add_option(name, value, help).type_name(type).check(refuse_empty_value);
  };
  const auto add_many = [&add](const std::string& name, auto& values, const std::string& help,
                               const std::string& type) { add(name, values, help, type).repeatable(); };
  add_isovalue_option(command, options->field);
  add_field_options(command, options->field);
  add_world_options(command, options->world);
  add("-o,--output", options->output, "The picture: .png", "PNG").required();
  add_many("--mesh", options->meshes, "Draw this mesh with its edges (repeatable: side by side)", "MESH");
  command.add_flag("--surface", options->surface, "Draw the isosurface itself beside the meshes");
  command.add_flag("--marching-cubes", options->marching_cubes, "Draw the mesh of marching cubes, beside the others");
  add_many("--clip", options->clips, "Cut away what lies between this plane of the world and the eye (repeatable)",
           "AXIS=VALUE");
  add("--view", options->view, "Direction of the eye in the world, in degrees; z is up", "AZIMUTH,ELEVATION")
      .show_default();
  add("--zoom", options->zoom, "1: the whole surface fits", "FACTOR").show_default();
  add("--look-at", options->look_at, "The middle of the picture, in the world (default: of the surface)", "X,Y,Z");
  add("--perspective", options->field_of_view, "Field of view; 0: parallel rays", "DEGREES").show_default();
  add("--size", options->size, "Of the whole picture (default 800x600, 600x600 for each of several parts)", "WxH");
  add("--samples", options->samples, "N x N rays per pixel", "N").show_default();
  add("--line-width", options->line_width, "Of the edges, in pixels; 0: none", "W").show_default();
  add("--threads", options->threads, "Threads to use (default: all)", "N");
  command.add_flag("--closed", options->closed, "Close the surface along the faces of the box (boundary = closed)");
  command.examples(
      "deliso render head.nrrd --isovalue 50 -o head.png\n"
      "deliso render head.nrrd --isovalue 50 --mesh head.ply --surface --clip x=80 -o cut.png");
  command.callback(exit_code, [options] { return run_render(*options); });
}

}  // namespace deliso
