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
#include "surface/certificate/promise.h"
#include "surface/deliso.h"
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

// Each sum and product is wrong by half a unit in the last place of what it is made of, a coordinate of a file by that
// of a float where it is one.
double rounding_of(const MeshOutput& output, const Box3& box) {
  constexpr double kOfDouble = 0x1p-53, kOfFloat = 0x1p-24;
  constexpr double kOperations = 8;  // on the way to the world and to the file, with metres
  const double relative = kOperations * kOfDouble + (keeps_floats(output.format) ? kOfFloat : 0);
  const Affine back = output.to_world.inverse();
  Vec3 farthest, off = {std::abs(output.to_world.offset.x), std::abs(output.to_world.offset.y),
                        std::abs(output.to_world.offset.z)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    farthest[axis] = std::max(std::abs(box.low[axis]), std::abs(box.high[axis])) + output.spacing[axis];
    for (std::size_t row = 0; row < 3; ++row) off[row] += std::abs(output.to_world.columns[axis][row]) * farthest[axis];
  }
  Vec3 moved = kOperations * kOfDouble * farthest;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis] += std::abs(back.columns[row][axis]) * relative * off[row];
  }
  return norm(moved) / output.voxel();
}

void judge_rounding(const TriangleMesh& mesh, const MeshOutput& output, double promised_distance,
                    Certificate& certificate) {
  const MeshFormat format = output.format;
  const Affine& to_world = output.to_world;
  const bool is_moved = !(to_world == Affine());
  if (!keeps_floats(format) && !is_moved) return;
  TriangleMesh rounded = as_stored(transformed(mesh, to_world), format, output.metres);
  if (!std::all_of(rounded.points.begin(), rounded.points.end(), is_finite)) return;
  const SelfIntersections found = self_intersections(rounded);
  // In STL vertices are one where they coincide; in other files they are what their numbers say.
  const std::int64_t together = format == MeshFormat::kStl ? coinciding(rounded.points) : 0;
  if (is_moved) rounded = transformed(std::move(rounded), to_world.inverse());
  double moved = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    moved = std::max(moved, distance(rounded.points[v], mesh.points[v]) / output.voxel());
  const std::int64_t meeting = found.meeting_pairs();
  const std::int64_t flat = found.zero_area_triangles;
  const bool is_flat = flat > count_without_area(mesh);
  const double allowed = kMostForRounding * std::min(Promise().max_residual, promised_distance);
  if (together == 0 && meeting == 0 && !is_flat && moved <= allowed) return;
  const std::string what = "; here vertices move by up to " + short_text(moved) + " voxels, " +
                           counted(together, "vertex coincides with another", "vertices coincide with others") + ", " +
                           counted(meeting, "pair of triangles meets", "pairs of triangles meet") + " and " +
                           counted(flat, "triangle has no area", "triangles have no area") + ".";
  certificate.broken.push_back(keeps_floats(format)
                                   ? output.name + ": " + std::string(name_of(format)) +
                                         " rounds coordinates to single precision" + what +
                                         " PLY, OFF and OBJ keep the mesh as it is; --local-origin helps far from the "
                                         "origin."
                                   : output.name + ": the map to the world rounds coordinates" + what);
}

}  // namespace deliso
