#include "surface/repair/rounds/sign_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>

#include "delaunay/base/rng.h"
#include "surface/extract/build_triangle_mesh.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::dense;
using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// V - E + F of a whole mesh, edges counted by their ends.
std::int64_t characteristic(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      ++edges[std::minmax(t[i], t[(i + 1) % 3])];
      used[t[i]] = true;
    }
  }
  return std::count(used.begin(), used.end(), true) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangles.size());
}

std::int64_t characteristic(const SignedDelaunay& restricted) {
  return characteristic(build_triangle_mesh(restricted).mesh);
}

TEST(LocalCharacteristic, ChangesAsThatOfTheWholeMesh) {
  std::map<std::int64_t, int> seen;
  std::vector<std::unique_ptr<Scene>> scenes;
  for (std::uint64_t seed = 0; seed < 6; ++seed) scenes.push_back(noise_scene({6, 5, 6}, seed));
  scenes.push_back(field_scene("gyroid", 10));
  scenes.push_back(field_scene("plane", 6));  // coplanar points: guards
  for (const auto& scene : scenes) {
    SignedDelaunay restricted = dense(*scene);
    Rng rng(7);
    std::int64_t before = characteristic(restricted);
    for (int trial = 0; trial < 200; ++trial) {
      const TetId t(static_cast<std::size_t>(rng.below(restricted.delaunay().tet_slots())));
      if (!restricted.delaunay().is_live(t)) continue;
      const TetSigns signs = restricted.signs();
      const std::int64_t change = euler_change(restricted, t);
      EXPECT_EQ(restricted.signs(), signs);
      restricted.flip_sign(t);
      const std::int64_t after = characteristic(restricted);
      ASSERT_EQ(change, after - before) << scene->name << " trial " << trial;
      before = after;
      ++seen[change];
    }
  }
  EXPECT_GT(seen.size(), 4u);
}

// Nearly all flips move the mesh and keep its topology, which is seen without building anything.
TEST(LocalCharacteristic, OfEveryTetrahedron) {
  int nothing = 0, something = 0;
  for (const auto& scene : {noise_scene({4, 3, 4}, 11), noise_scene({3, 3, 4}, 12), field_scene("gyroid", 6)}) {
    SignedDelaunay restricted = dense(*scene);
    const Tetrahedralization& delaunay = restricted.delaunay();
    const std::int64_t before = characteristic(restricted);
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      const TetId t(i);
      if (!delaunay.is_live(t)) continue;
      const std::int64_t change = euler_change(restricted, t);
      restricted.flip_sign(t);
      ASSERT_EQ(change, characteristic(restricted) - before) << scene->name << " tetrahedron " << i;
      restricted.flip_sign(t);
      ++(change == 0 ? nothing : something);
    }
  }
  EXPECT_GT(nothing, 500);
  EXPECT_GT(something, 50);
}

// The difference between the topology of a component and that of its main piece.
std::int64_t amount_missing(const MatchedMesh& mesh, const ComponentTopology& want, std::uint32_t component) {
  const std::uint32_t main = mesh.match.main_piece[component];
  const ComponentTopology have = main == kNoPiece ? ComponentTopology{} : mesh.match.pieces[main].topology;
  return std::abs(want.euler_characteristic - have.euler_characteristic) +
         std::abs(want.boundary_loops - have.boundary_loops);
}

IndexRanges boxes_at(const CellLevels& cells, const Tetrahedralization& delaunay, TetId t) {
  Vec3 centre;
  for (const VertexId v : delaunay.vertices(t)) centre += 0.25 * delaunay.point(v);
  const CellIndex cell = cells.cell_of(centre);
  IndexBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) box[axis] = {cell[axis] + 1, cell[axis] + 1};
  return {{box}, {box}};
}

// Flips the sign of one tetrahedron without a constraint such that a component has one handle more or less.
TEST(SignSearch, CorrectsAFlippedSign) {
  int mended = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto scene = noise_scene({7, 7, 7}, seed);
    const CellLevels cells(*scene->isosurface);
    RepairRound round(scene->surface(), cells,
                      std::make_unique<SignedDelaunay>(*scene->isosurface, testing::crossing_points(*scene)));
    round.take_signs();
    const MatchedMesh before = *round.assemble();
    const TetSigns signs = round.restricted().signs();
    const Tetrahedralization& delaunay = round.restricted().delaunay();
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      const TetId flipped(i);
      if (!delaunay.is_live(flipped) || delaunay.is_ghost(flipped)) continue;
      if (round.euler_change(flipped) == 0) continue;
      round.flip_sign(flipped);
      const std::optional<MatchedMesh> mesh = round.assemble();
      for (std::uint32_t c = 0; mesh && c < scene->topology.components.size(); ++c) {
        const ComponentTopology& want = scene->topology.components[c];
        if (amount_missing(*mesh, want, c) <= amount_missing(before, want, c)) continue;
        if (mesh->match.error < before.match.error) continue;  // the flip improved other components
        std::shared_ptr<MatchedMesh> best;
        std::vector<bool> done(scene->topology.components.size(), true);
        done[c] = false;
        const auto improved = [&](std::shared_ptr<MatchedMesh> better) {
          best = std::move(better);
          done[c] = amount_missing(*best, want, c) <= amount_missing(before, want, c);
        };
        Controls controls(BudgetParameters{}, nullptr, {});
        std::vector<IndexRanges> boxes(scene->topology.components.size());
        boxes[c] = boxes_at(cells, delaunay, flipped);
        SignSearch(round, scene->topology, cells, boxes)
            .mend(std::make_shared<MatchedMesh>(*mesh), done, improved, controls);
        ASSERT_NE(best, nullptr) << "seed " << seed << " tetrahedron " << i;
        EXPECT_LE(amount_missing(*best, want, c), amount_missing(before, want, c));
        EXPECT_LE(best->match.error, mesh->match.error);
        ++mended;
        break;
      }
      round.set_signs(signs);
    }
  }
  EXPECT_GT(mended, 15);
}

}  // namespace
}  // namespace deliso
