// Positions that a report tells lie where the mesh lies, also of volumes that are turned in the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "experiments/config/json.h"
#include "surface/mesh/io/mesh_io.h"
#include "tests/support/program_runner.h"

namespace deliso::testing {
namespace {

// Rotated and reflected, unequal spacings (1.25, 2.5, 1.5), far from the origin.
std::string turned_volume(const std::string& sizes, const std::vector<float>& samples) {
  std::string bytes(samples.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return "NRRD0005\ntype: float\ndimension: 3\nsizes: " + sizes +
         "\nencoding: raw\nendian: little\nspace: left-posterior-superior\nspace directions: (0.75,1,0) (-2,1.5,0) "
         "(0,0,-1.5)\nspace origin: (-20.5,33.25,1007)\n\n" +
         bytes;
}

Vec3 position_of(const Json& entry) {
  const Json& p = entry["position"];
  return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
}

double distance_to_vertices(const Vec3& p, const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& q : mesh.points) least = std::min(least, distance(p, q));
  return least;
}

class WorldPositions : public ::testing::Test {
 protected:
  // The mesh, its report into `report_`, and what was said on stderr into `remarks_`.
  TriangleMesh mesh(std::vector<std::string> more) {
    std::vector<std::string> arguments{"mesh", volume_, "-o", folder_ / "m.ply", "--report", folder_ / "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_deliso(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    remarks_ = result.err;
    report_ = read_json(folder_ / "r.json");
    return read_mesh(folder_ / "m.ply");
  }

  TemporaryFolder folder_;
  std::string volume_ = folder_ / "v.nrrd";
  std::string remarks_;
  Json report_;
};

TEST_F(WorldPositions, WhatWasLeftOutWasThere) {
  std::vector<float> samples;
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 18; ++j)
      for (int i = 0; i < 20; ++i)
        samples.push_back(static_cast<float>(std::max(100 - 22 * std::hypot(i - 5, 1.1 * j - 7, 1.2 * k - 8),
                                                      100 - 30 * std::hypot(i - 15, 1.1 * j - 7, 1.2 * k - 8))));
  write_file(volume_, turned_volume("20 18 16", samples));
  for (const std::string space : {"LPS", "RAS"}) {
    const TriangleMesh all = mesh({"--isovalue", "40.3", "--space", space});
    const TriangleMesh largest = mesh({"--isovalue", "40.3", "--space", space, "--keep-largest", "1"});
    ASSERT_EQ(report_["dropped"].size(), 1u);
    const Vec3 position = position_of(report_["dropped"][0]);
    EXPECT_LT(distance_to_vertices(position, all), 0.5) << space;
    EXPECT_GT(distance_to_vertices(position, largest), 2) << space;
  }
}

TEST_F(WorldPositions, TheWorstTrianglesAreThere) {
  // Of random samples the isosurface has necks and creases.
  Rng rng(8);
  std::vector<float> samples;
  for (int n = 0; n < 8 * 7 * 6; ++n) samples.push_back(std::vector<float>{0, 1, 5, 100}.at(rng.next() % 4));
  write_file(volume_, turned_volume("8 7 6", samples));
  const TriangleMesh made = mesh({"--isovalue", "2.3", "--max-error", "0.3"});
  const Json& worst = report_["stages"]["shape"]["worst"];
  ASSERT_FALSE(worst.empty()) << "another seed is needed";
  for (const Json& entry : worst) EXPECT_LT(distance_to_vertices(position_of(entry), made), 1);
  // The remark names the first: its last number is the third coordinate.
  const std::size_t at = remarks_.find(" degrees, at ");
  ASSERT_NE(at, std::string::npos) << remarks_;
  EXPECT_NE(remarks_.find(' ' + std::to_string(static_cast<int>(position_of(worst[0]).z)), at), std::string::npos)
      << remarks_;
}

}  // namespace
}  // namespace deliso::testing
