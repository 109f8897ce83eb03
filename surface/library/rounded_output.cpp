#include "surface/library/rounded_output.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/mesh_frame.h"
#include "surface/mesh/triangle_area.h"

namespace deliso {
namespace {

std::int64_t coinciding(std::vector<Vec3> points) {
  const auto coordinates = [](const Vec3& p) { return std::tie(p.x, p.y, p.z); };
  std::sort(points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return coordinates(a) < coordinates(b); });
  std::int64_t count = 0;
  for (std::size_t i = 1; i < points.size(); ++i) count += points[i] == points[i - 1] ? 1 : 0;
  return count;
}

}  // namespace

void judge_rounding(const TriangleMesh& mesh, const Affine& to_world, double voxel, const std::string& path,
                    MeshFormat format, std::optional<double> metres, Certificate& certificate) {
  const bool is_moved = !(to_world == Affine());
  if (!keeps_floats(format) && !is_moved) return;
  // The verification allows vertices within 1e-3 voxel of the isosurface; before rounding ours are within 3e-4.
  constexpr double kFarthest = 5e-4;
  TriangleMesh rounded = as_stored(transformed(mesh, to_world), format, metres);
  if (!std::all_of(rounded.points.begin(), rounded.points.end(), is_finite)) return;
  const std::int64_t flat_as_written = count_without_area(rounded);
  if (is_moved) rounded = transformed(std::move(rounded), to_world.inverse());
  double moved = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    moved = std::max(moved, distance(rounded.points[v], mesh.points[v]) / voxel);
  // In STL vertices are one where they coincide; in other files they are what their numbers say.
  const std::int64_t together = format == MeshFormat::kStl ? coinciding(rounded.points) : 0;
  const SelfIntersections found = self_intersections(rounded);
  const std::int64_t crossing = found.crossing_pairs;
  const bool crosses = crossing > 0 && crossing > self_intersections(mesh).crossing_pairs;
  const std::int64_t flat = std::max(flat_as_written, found.zero_area_triangles);
  const bool is_flat = flat > count_without_area(mesh);
  if (together == 0 && !crosses && !is_flat && moved <= kFarthest) return;
  const std::string what = "; here vertices move by up to " + short_text(moved) + " voxels, " +
                           counted(together, "vertex coincides with another", "vertices coincide with others") + ", " +
                           counted(crossing, "pair of triangles crosses", "pairs of triangles cross") + " and " +
                           counted(flat, "triangle has no area", "triangles have no area") + ".";
  certificate.broken.push_back(keeps_floats(format)
                                   ? path + ": " + std::string(name_of(format)) +
                                         " rounds coordinates to single precision" + what +
                                         " PLY, OFF and OBJ keep the mesh as it is; --local-origin helps far from the "
                                         "origin."
                                   : path + ": the map to the world rounds coordinates" + what);
}

}  // namespace deliso
