// Marching cubes as a variant of an experiment, and the points at which both meshes are measured.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiments/runs/isosurface_samples.h"
#include "experiments/runs/record_file.h"
#include "tests/support/run_examples.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/marching_cubes/marching_cubes.h"

namespace deliso::testing {
namespace {

// The trilinear interpolant at a point within the grid, straight from its definition.
double interpolated(const ScalarGrid& grid, const Vec3& p) {
  const Vec3 d = p - grid.origin();
  const Vec3 index{d.x / grid.spacing().x, d.y / grid.spacing().y, d.z / grid.spacing().z};
  std::array<std::int32_t, 3> low{};
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::min(static_cast<std::int32_t>(std::floor(index[a])), grid.dims()[a] - 2);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<std::int32_t, 3> at = low;
    for (std::size_t a = 0; a < 3; ++a) {
      const double t = index[a] - low[a];
      const bool upper = (corner >> a & 1) != 0;
      weight *= upper ? t : 1 - t;
      at[a] += upper ? 1 : 0;
    }
    sum += weight * grid.at(at[0], at[1], at[2]);
  }
  return sum;
}

TEST(IsosurfaceSamples, LieOnTheInterpolantAwayFromGridEdges) {
  const ScalarGrid field = generate_field("gyroid_ball", 14);
  const double isovalue = find_analytic_field("gyroid_ball").isovalue;
  const ScalarGrid grid(field.dims(), field.samples(), {1, 2, 0.5}, {3, -4, 5});
  const std::vector<Vec3> points = isosurface_samples(grid, isovalue);
  EXPECT_GT(points.size(), 100u);
  const auto [low, high] = grid.range();
  for (const Vec3& p : points) {
    EXPECT_NEAR(interpolated(grid, p), isovalue, 1e-5 * (high - low));
    // Two of its coordinates are those of a cell's middle.
    int middles = 0;
    const Vec3 d = p - grid.origin();
    for (std::size_t a = 0; a < 3; ++a) {
      const double index = d[a] / grid.spacing()[a];
      if (std::abs(index - std::floor(index) - 0.5) < 1e-9) ++middles;
    }
    EXPECT_GE(middles, 2);
  }
}

TEST(IsosurfaceSamples, APlaneIsMetOnceByEveryLineAcrossIt) {
  // g = x on 5 x 4 x 3 samples: the 3 x 2 lines along x meet the plane x = 1.25.
  std::vector<float> samples;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 5; ++i) samples.push_back(static_cast<float>(i));
    }
  }
  const std::vector<Vec3> points = isosurface_samples(ScalarGrid({5, 4, 3}, samples), 1.25);
  ASSERT_EQ(points.size(), 6u);
  for (const Vec3& p : points) EXPECT_EQ(p.x, 1.25);
}

TEST(Baseline, MarchingCubesIsAVariantWithTheSameFigures) {
  const TemporaryFolder folder;
  Json document = small_document();
  document["distances"] = true;
  document["repeats"] = 1;
  document["variants"].push_back(Json{{"name", "cubes"}, {"mesher", "marching_cubes"}});
  document["metrics"] = parse_json(R"([{"name": "n", "value": "vertices"},
    {"name": "stage 1", "value": "stages.recover.insertions"}, {"name": "verdict", "value": "certificate.verdict"},
    {"name": "far", "value": "distances.isosurface_samples_to_mesh_max_voxels"}])",
                                   "metrics");
  write_file(folder / "small.json", json_text(document));
  const ProgramResult result = run_deliso({"run", folder / "small.json", "--out", folder / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("- cubes: marching cubes\n"), std::string::npos) << result.out;
  std::vector<std::string> notes;
  int compared = 0;
  for (const Json& record : read_records(folder / "out/records.jsonl", notes)) {
    EXPECT_EQ(record["certificate"]["verdict"], "homeomorphic");
    EXPECT_GT(record["distances"]["isosurface_samples_to_mesh_mean_voxels"], 0);
    EXPECT_GE(record["distances"]["isosurface_samples_to_mesh_max_voxels"],
              record["distances"]["isosurface_samples_to_mesh_mean_voxels"]);
    if (record["variant"] != "cubes") continue;
    const bool ball = record["dataset"] == "ball";
    const std::string field = ball ? "sphere" : "torus";
    const MarchingCubesMesh mesh =
        marching_cubes(generate_field(field, ball ? 8 : 10), find_analytic_field(field).isovalue);
    EXPECT_EQ(record["vertices"], mesh.points.size());
    EXPECT_EQ(record["triangles"], mesh.triangles.size());
    EXPECT_EQ(record["euler_characteristic"], ball ? 2 : 0);
    EXPECT_FALSE(record.contains("stages"));
    std::int64_t counted = 0;
    for (const Json& count : record["quality"]["min_angle_histogram"]) counted += count.get<std::int64_t>();
    EXPECT_EQ(counted, static_cast<std::int64_t>(mesh.triangles.size()));
    ++compared;
  }
  EXPECT_EQ(compared, 2);
}

}  // namespace
}  // namespace deliso::testing
