// Meshes whose facets are restricted by the hits of their dual edges (kHits), not by the signs of tetrahedra.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "delaunay/base/check.h"
#include "surface/deliso.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"

namespace deliso {
namespace {

MeshingResult mesh_field(const std::string& name, std::int32_t size, MeshingOptions options = {}) {
  return mesh_isosurface(generate_field(name, size), find_analytic_field(name).isovalue, options);
}

MeshingOptions by_hits() {
  MeshingOptions options;
  options.parameters.stage1.one_sign_per_tetrahedron = false;
  options.parameters.stage1.coverage = false;
  options.parameters.repair.max_rounds = 0;
  return options;
}

TEST(Deliso, FacetsByHitsGiveTheSameMeshWhereNoHitContradictsTheSigns) {
  for (const char* name : {"torus", "gyroid"}) {
    SCOPED_TRACE(name);
    MeshingOptions by_signs = by_hits();
    by_signs.parameters.stage1.one_sign_per_tetrahedron = true;
    const MeshingResult a = mesh_field(name, 20, by_signs);
    const MeshingResult b = mesh_field(name, 20, by_hits());
    EXPECT_EQ(a.recover.hits_against_signs, 0);
    EXPECT_EQ(a.mesh.points, b.mesh.points);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(b.certificate.verdict, Verdict::kHomeomorphic);
  }
}

// Rings near the sampling limit: some facets are left that bound nothing. With the rule kSigns they always bound a set.
TEST(Deliso, FacetsByHitsThatBoundNothingAreRefuted) {
  for (const Algorithm algorithm : {Algorithm::kTwoStage, Algorithm::kFull3d}) {
    MeshingOptions options = by_hits();
    options.parameters.algorithm = algorithm;
    options.parameters.budget.max_vertices = 20000;
    const MeshingResult result = mesh_field("marschner_lobb", 41, options);
    EXPECT_GT(result.recover.hits_against_signs, 0);
    EXPECT_FALSE(result.build.bounds_a_solid);
    EXPECT_EQ(result.refine.insertions, 0);
    EXPECT_EQ(result.certificate.verdict, Verdict::kDifferent);
    ASSERT_FALSE(result.certificate.differences.empty());
    EXPECT_NE(result.certificate.differences[0].find("bound no set of tetrahedra"), std::string::npos);
    EXPECT_GT(result.mesh.triangles.size(), 1000u);
  }
}

TEST(Deliso, FacetsByHitsAreRefusedWhereSomethingBuildsOnSigns) {
  const auto refuse = [](auto change) {
    MeshingOptions options = by_hits();
    change(options.parameters);
    EXPECT_THROW(mesh_field("torus", 12, options), InputError);
  };
  refuse([](Parameters& p) { p.repair.max_rounds = 1; });
  refuse([](Parameters& p) { p.stage1.coverage = true; });
  refuse([](Parameters& p) { p.certify = false; });
}

}  // namespace
}  // namespace deliso
