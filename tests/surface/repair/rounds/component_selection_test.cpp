// The final selection must not depend on the meshes and pieces that were dropped meanwhile.
#include "surface/repair/rounds/component_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "surface/extract/edge_positions.h"
#include "surface/extract/pinch_separation.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::Scene;

// The corners of a triangle, the least first, each with its pole height.
using PlacedTriangle = std::array<std::array<double, 4>, 3>;

void append_pieces_placed(const SurfaceMesh& mesh, const std::function<bool(std::uint32_t)>& is_wanted,
                          std::vector<PlacedTriangle>& triangles) {
  for (const auto& v : mesh.triangles) {
    if (!is_wanted(v[0])) continue;
    PlacedTriangle placed;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[v[i]];
      placed[i] = {p.x, p.y, p.z, mesh.pole_heights[v[i]]};
    }
    std::rotate(placed.begin(), std::min_element(placed.begin(), placed.end()), placed.end());
    triangles.push_back(placed);
  }
}

// Noise at a high isovalue: many small components, some of which touch when signs are wrong.
std::unique_ptr<Scene> blobs(std::uint64_t seed) {
  Rng rng(seed);
  return std::make_unique<Scene>("blobs", testing::noise_grid({10, 9, 9}, {1, 1, 1}, rng), 190.5);
}

// Meshes of one round with randomly flipped signs, each with its signs.
struct Attempts {
  explicit Attempts(const Scene& scene, std::uint64_t seed)
      : cells(*scene.isosurface),
        round(scene.surface(), cells,
              std::make_unique<SignedDelaunay>(*scene.isosurface, testing::crossing_points(scene))) {
    constexpr int kAttempts = 8;
    Rng rng(seed);
    round.take_plain_signs();
    for (int i = 0; i < kAttempts; ++i) {
      const TetSigns before = round.restricted().signs();
      TetSigns flipped = before;
      for (std::size_t t = 0; t < before.size(); ++t) {
        const bool is_live = round.restricted().delaunay().is_live(TetId(t));
        if (is_live && i > 0 && rng.below(100) < 3) flipped[t] = flipped[t] == 0 ? 1 : 0;
      }
      round.set_signs(flipped);
      meshes.push_back(round.assemble());
      signs.push_back(round.restricted().signs());
      round.set_signs(before);
    }
  }
  CellLevels cells;
  RepairRound round;
  std::vector<MatchedMesh> meshes;
  std::vector<TetSigns> signs;
};

// Some components that are right count as displaced: of these the first one is the best, of all others the latest.
void displace_some(std::vector<MatchedMesh>& meshes, std::uint64_t seed) {
  Rng rng(seed);
  for (MatchedMesh& mesh : meshes) {
    for (Agreement& agreement : mesh.match.agreement) {
      if (agreement >= Agreement::kDisplaced && rng.below(3) > 0) agreement = Agreement::kDisplaced;
    }
  }
}

// Every vertex that was not moved must lie on the component given for it.
void expect_true_components(const AssembledMesh& assembled, const Scene& scene) {
  ASSERT_EQ(assembled.component.size(), assembled.mesh.points.size());
  const std::vector<Vec3> samples = testing::crossing_points(scene);
  std::size_t unmoved = 0;
  for (std::size_t v = 0; v < assembled.component.size(); ++v) {
    const Vec3& p = assembled.mesh.points[v];
    if (std::find(samples.begin(), samples.end(), p) == samples.end()) continue;
    ++unmoved;
    EXPECT_EQ(assembled.component[v], component_of(scene.grid, scene.isosurface->isovalue(), scene.topology, p));
  }
  EXPECT_GT(2 * unmoved, assembled.component.size());
}

TEST(ComponentSelection, GiveEachComponentAsTheLatestOfTheBestHasIt) {
  std::size_t given_by_earlier = 0, displaced_again = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    const auto scene = blobs(seed);
    const std::size_t components = scene->topology.components.size();
    const Box3& box = scene->isosurface->box();
    Attempts attempts(*scene, seed);
    displace_some(attempts.meshes, seed);
    ComponentSelection kept(components);
    // The expected result: which mesh gives each component.
    std::vector<Agreement> best(components, Agreement::kNone);
    std::vector<std::optional<std::size_t>> giver(components);
    for (std::size_t i = 0; i < attempts.meshes.size(); ++i) {
      const std::vector<Agreement>& agreement = attempts.meshes[i].match.agreement;
      bool helps = false;
      for (std::size_t c = 0; c < components; ++c) helps = helps || agreement[c] > best[c];
      for (std::size_t c = 0; c < components && helps; ++c) {
        if (agreement[c] == Agreement::kDisplaced && best[c] == Agreement::kDisplaced) {
          ++displaced_again;
          continue;
        }
        best[c] = std::max(best[c], std::min(agreement[c], Agreement::kWithStrays));
        if (agreement[c] > Agreement::kPartial && agreement[c] >= best[c]) giver[c] = i;
      }
      kept.keep(std::make_shared<MatchedMesh>(attempts.meshes[i]), attempts.signs[i]);
    }
    std::vector<PlacedTriangle> expected;
    std::vector<std::optional<MatchedMesh>> wholes(attempts.meshes.size());  // with heights and other positions
    for (std::size_t c = 0; c < components; ++c) {
      if (!giver[c]) continue;
      given_by_earlier += *giver[c] + 1 < attempts.meshes.size() ? 1 : 0;
      std::optional<MatchedMesh>& whole = wholes[*giver[c]];
      if (!whole) {
        whole = attempts.meshes[*giver[c]];
        attempts.round.set_signs(attempts.signs[*giver[c]]);
        const auto heights = compute_poles(attempts.round.restricted());
        for (const VertexId v : whole->built.vertex_of) whole->built.mesh.pole_heights.push_back(heights[v.index()]);
        find_other_positions(whole->built.groups, *scene->isosurface);
      }
      MatchedMesh mesh = *whole;
      const auto is_wanted = [&](std::uint32_t v) { return mesh.match.piece_of[v] == mesh.match.main_piece[c]; };
      separate_pinches(mesh.built.mesh, mesh.built.groups, mesh.built.vertex_of, box, box, is_wanted);
      append_pieces_placed(mesh.built.mesh, is_wanted, expected);
    }

    const TetSigns signs = attempts.round.restricted().signs();
    kept.give_poles(attempts.round);
    EXPECT_EQ(attempts.round.restricted().signs(), signs);
    std::sort(expected.begin(), expected.end());
    EXPECT_FALSE(expected.empty());
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(threads);
      std::vector<bool> left;
      RepairStats stats;
      const AssembledMesh assembled = kept.assemble(left, *scene->isosurface, threads, stats);
      std::vector<PlacedTriangle> found;
      append_pieces_placed(
          assembled.mesh, [](std::uint32_t) { return true; }, found);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
      expect_true_components(assembled, *scene);
    }
  }
  EXPECT_GT(given_by_earlier, 10u);
  EXPECT_GT(displaced_again, 10u);
}

}  // namespace
}  // namespace deliso
