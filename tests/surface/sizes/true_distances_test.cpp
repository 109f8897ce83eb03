// A stated error holds everywhere: at every point of the mesh and at every point of the isosurface, whatever the mesher
// and the verification look at.
#include <gtest/gtest.h>

#include <ostream>

#include "surface/deliso.h"
#include "surface/verification/isosurface_probe.h"
#include "surface/verification/surface_distance.h"
#include "volume/fields/analytic_fields.h"
#include "volume/filters/finer_grid.h"
#include "volume/regular_isovalue.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

struct Stated {
  const char* field;
  std::int32_t size;
  double max_error;

  friend std::ostream& operator<<(std::ostream& out, const Stated& c) {
    return out << c.field << " " << c.size << " at " << c.max_error;
  }
};

// Each triangle as `parts` times `parts` smaller ones.
TriangleMesh divided(const TriangleMesh& mesh, int parts) {
  TriangleMesh fine;
  for (const auto& corners : mesh.triangles) {
    const Vec3 a = mesh.points[corners[0]], ab = (mesh.points[corners[1]] - a) / parts,
               ac = (mesh.points[corners[2]] - a) / parts;
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        const auto next = static_cast<std::uint32_t>(fine.points.size());
        const Vec3 corner = a + double(i) * ab + double(j) * ac;
        for (const Vec3& p : {corner, corner + ab, corner + ac}) fine.points.push_back(p);
        fine.triangles.push_back({next, next + 1, next + 2});
      }
    }
  }
  return fine;
}

// The crossings of the same isosurface with a grid so many times as fine.
std::vector<Vec3> finer_crossings(const ScalarGrid& grid, double isovalue, int times) {
  const ScalarGrid fine = *finer_grid(grid, {{0, 0, 0}, grid.dims()}, {times, times, times}, std::int64_t{1} << 25);
  std::vector<Vec3> points;
  for (const EdgeCrossing& crossing : exact_topology(fine, regular_isovalue(fine, isovalue)).crossings) {
    points.push_back(crossing_position(fine, crossing) / times);
  }
  return points;
}

class TrueDistances : public ::testing::TestWithParam<Stated> {};

// Measured at points a voxel apart, beside creases and at the edges of the grid, they were up to twice the error.
TEST_P(TrueDistances, AreWithinTheErrorStated) {
  constexpr double kRounding = 1 + 1e-3;  // of crossings with the finer grid, and of feet
  const Stated& c = GetParam();
  const ScalarGrid grid = generate_field(c.field, c.size);
  MeshingOptions options;
  options.parameters.size.max_error = c.max_error;
  const MeshingResult result = mesh_isosurface(grid, find_analytic_field(c.field).isovalue, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_EQ(result.repair.components_polygonized, 0);
  const IsosurfaceTopology truth = exact_topology(grid, result.isovalue_used);
  IsosurfaceProbe probe(grid, result.isovalue_used, truth.crossings);
  // The bound lets the probe look all around where a foot is farther.
  const double most = kRounding * c.max_error;
  EXPECT_LE(triangles_to_isosurface(divided(result.mesh, 8), probe, most).max_voxels, most);
  const std::vector<Vec3> points = finer_crossings(grid, result.isovalue_used, 7);
  EXPECT_LE(points_to_mesh(points, result.mesh, 1e9, most).max_voxels, most);
}

INSTANTIATE_TEST_SUITE_P(Fields, TrueDistances,
                         ::testing::Values(Stated{"torus", 16, 0.02}, Stated{"shells", 20, 0.2},
                                           Stated{"gyroid_ball", 20, 0.2}, Stated{"marschner_lobb", 21, 0.2},
                                           Stated{"noise", 8, 0.5}, Stated{"noise", 8, 0.2}, Stated{"noise", 6, 0.1}));

}  // namespace
}  // namespace deliso
