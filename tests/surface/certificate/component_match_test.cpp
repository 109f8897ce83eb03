#include "surface/certificate/component_match.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/certificate/mesh_pieces.h"
#include "surface/extract/build_triangle_mesh.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::Scene;

// A mesh sampled densely enough to be right, with the exact component of each vertex.
struct Sampled {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> component;
};

Sampled dense_mesh(const Scene& scene) {
  std::vector<Vec3> points;
  for (const EdgeCrossing& c : scene.topology.crossings) points.push_back(crossing_position(scene.grid, c));
  Sampled sampled;
  sampled.mesh = build_triangle_mesh(SignedDelaunay(*scene.isosurface, points)).mesh;
  for (const Vec3& p : sampled.mesh.points) {
    sampled.component.push_back(component_of(scene.grid, scene.isovalue, scene.topology, p).value());
  }
  return sampled;
}

// Takes one triangle out of a mesh.
void punch_hole(SurfaceMesh& mesh, std::uint32_t triangle) {
  const auto last = static_cast<std::uint32_t>(mesh.triangles.size() - 1);
  for (const TriangleSide side : mesh.neighbours[triangle]) {
    if (side != kNoSide) mesh.neighbours[side >> 2][side & 3u] = kNoSide;
  }
  if (triangle != last) {
    mesh.triangles[triangle] = mesh.triangles[last];
    mesh.neighbours[triangle] = mesh.neighbours[last];
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide side = mesh.neighbours[triangle][i];
      if (side != kNoSide) mesh.neighbours[side >> 2][side & 3u] = 4 * triangle + i;
    }
  }
  mesh.triangles.pop_back();
  mesh.neighbours.pop_back();
}

TEST(ComponentMatch, RightMeshesMatchPieceByPiece) {
  for (const auto& scene : {field_scene("bubbles", 26), field_scene("linked_tori", 40), field_scene("sheets", 20)}) {
    SCOPED_TRACE(scene->name);
    const Sampled sampled = dense_mesh(*scene);
    const ComponentMatch match = match_components(sampled.mesh, sampled.component, scene->topology.components);
    EXPECT_EQ(match.error, 0);
    for (const Agreement agreement : match.agreement) EXPECT_EQ(agreement, Agreement::kExact);
    EXPECT_EQ(match.pieces.size(), scene->topology.components.size());
    for (const MeshPiece& piece : match.pieces) {
      EXPECT_FALSE(piece.mixed);
      EXPECT_EQ(piece.topology, scene->topology.components[piece.component]);
    }
    for (std::size_t v = 0; v < sampled.component.size(); ++v) {
      EXPECT_EQ(match.pieces[match.piece_of[v]].component, sampled.component[v]);
    }
  }
}

TEST(ComponentMatch, AHoleBreaksTheMatchOfItsComponentOnly) {
  const auto scene = field_scene("linked_tori", 40);
  Sampled sampled = dense_mesh(*scene);
  const std::uint32_t hurt = sampled.component[sampled.mesh.triangles[5][0]];
  punch_hole(sampled.mesh, 5);
  ASSERT_EQ(testing::surface_mesh_defect(sampled.mesh), "");
  const ComponentMatch match = match_components(sampled.mesh, sampled.component, scene->topology.components);
  EXPECT_EQ(match.error, 2);  // one component, one less in Euler characteristic
  EXPECT_EQ(match.agreement[hurt], Agreement::kNone);
  EXPECT_EQ(match.agreement[1 - hurt], Agreement::kExact);
  for (const MeshPiece& piece : match.pieces) {
    if (piece.component == hurt) {
      EXPECT_EQ(piece.topology, (ComponentTopology{-1, 1}));
    }
  }
}

TEST(ComponentMatch, AMissingComponentAndAStrayPieceAreCounted) {
  const auto scene = field_scene("bubbles", 26);
  const Sampled sampled = dense_mesh(*scene);
  const ComponentMatch right = match_components(sampled.mesh, sampled.component, scene->topology.components);
  std::vector<bool> wanted(right.pieces.size(), true);
  wanted[2] = false;
  SurfaceMesh some;
  std::vector<std::uint32_t> component;
  SurfaceMesh with_heights = sampled.mesh;
  with_heights.pole_heights.assign(with_heights.points.size(), 1);
  append_pieces(with_heights, right.piece_of, wanted, some);
  for (std::size_t v = 0; v < sampled.component.size(); ++v) {
    if (right.piece_of[v] != 2) component.push_back(sampled.component[v]);
  }
  ComponentMatch match = match_components(some, component, scene->topology.components);
  const std::uint32_t missing = right.pieces[2].component;
  EXPECT_EQ(match.error, 3);  // one component, two less in Euler characteristic
  EXPECT_EQ(match.agreement[missing], Agreement::kNone);
  EXPECT_EQ(match.main_piece[missing], kNoPiece);

  // One of the pieces a second time: its component then agrees but for a stray.
  wanted.assign(right.pieces.size(), false);
  wanted[0] = true;
  append_pieces(with_heights, right.piece_of, wanted, some);
  for (std::size_t v = 0; v < sampled.component.size(); ++v) {
    if (right.piece_of[v] == 0) component.push_back(sampled.component[v]);
  }
  ASSERT_EQ(testing::surface_mesh_defect(some), "");
  match = match_components(some, component, scene->topology.components);
  EXPECT_EQ(match.agreement[right.pieces[0].component], Agreement::kWithStrays);
  EXPECT_EQ(match.error, 3 + 2);
}

TEST(ComponentMatch, AVertexOfAnotherComponentMakesBothMixed) {
  const auto scene = field_scene("linked_tori", 40);
  Sampled sampled = dense_mesh(*scene);
  const auto first = std::find(sampled.component.begin(), sampled.component.end(), 0u);
  *first = 1;
  const ComponentMatch match = match_components(sampled.mesh, sampled.component, scene->topology.components);
  EXPECT_EQ(match.agreement, (std::vector<Agreement>{Agreement::kMixed, Agreement::kMixed}));
  EXPECT_EQ(std::count_if(match.pieces.begin(), match.pieces.end(), [](const auto& p) { return p.mixed; }), 1);
}

TEST(ComponentMatch, VerticesOnNoComponentDoNotCount) {
  const auto scene = field_scene("bubbles", 26);
  Sampled sampled = dense_mesh(*scene);
  const ComponentMatch whole = match_components(sampled.mesh, sampled.component, scene->topology.components);
  // Some vertices of a piece of the last component, then all of them.
  const auto last = static_cast<std::uint32_t>(scene->topology.components.size() - 1);
  const std::uint32_t piece = whole.main_piece[last];
  int left_on = 3;
  for (const bool takes_all : {false, true}) {
    for (std::size_t v = 0; v < sampled.component.size(); ++v) {
      if (whole.piece_of[v] == piece && (takes_all || left_on-- > 0)) sampled.component[v] = kNoComponent;
    }
    const ComponentMatch match = match_components(sampled.mesh, sampled.component, scene->topology.components);
    EXPECT_EQ(match.pieces[piece].component, takes_all ? kNoComponent : last);
    EXPECT_FALSE(match.pieces[piece].mixed);
    EXPECT_EQ(match.is_main(piece), !takes_all);
    for (std::uint32_t c = 0; c <= last; ++c) {
      EXPECT_EQ(match.agreement[c], takes_all && c == last ? Agreement::kNone : Agreement::kExact) << c;
    }
    EXPECT_EQ(match.error > 0, takes_all);
  }
}

}  // namespace
}  // namespace deliso
