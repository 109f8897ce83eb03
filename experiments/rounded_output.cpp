#include "experiments/rounded_output.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "delaunay/base/counted.h"
#include "surface/mesh_io.h"
#include "surface/self_intersection.h"

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

void judge_rounding(const TriangleMesh& mesh, const std::filesystem::path& path, Certificate& certificate) {
  if (!keeps_floats(path)) return;
  TriangleMesh rounded = mesh;
  for (Vec3& p : rounded.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<float>(p[axis]));
  }
  const std::int64_t together = coinciding(rounded.points);
  const std::int64_t crossing = self_intersections(rounded).crossing_pairs;
  if (together == 0 && (crossing == 0 || crossing <= self_intersections(mesh).crossing_pairs)) return;
  if (certificate.verdict == Verdict::kHomeomorphic) certificate.verdict = Verdict::kDifferent;
  certificate.differences.push_back(
      path.string() + ": STL rounds coordinates to single precision; here " +
      counted(together, "vertex coincides with another", "vertices coincide with others") + " and " +
      counted(crossing, "pair of triangles crosses", "pairs of triangles cross") +
      ". PLY, OFF and OBJ keep the mesh as it is.");
}

}  // namespace deliso
