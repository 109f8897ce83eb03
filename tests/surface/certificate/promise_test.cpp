// A sentence for each condition of a proven mesh that does not hold, and none where all hold.
#include "surface/certificate/promise.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace deliso {
namespace {

PromiseFigures kept() {
  PromiseFigures figures;
  figures.triangles = 20;
  figures.is_manifold = true;
  figures.topology = Verdict::kHomeomorphic;
  return figures;
}

TEST(Promise, IsKeptWhereNothingIsWrong) { EXPECT_TRUE(broken_promises(kept(), {}).empty()); }

TEST(Promise, HasASentenceForEachCondition) {
  const std::vector<std::function<void(PromiseFigures&)>> faults = {
      [](PromiseFigures& f) { f.triangles = 0; },
      [](PromiseFigures& f) { f.is_manifold = false; },
      [](PromiseFigures& f) { f.misoriented_edges = 1; },
      [](PromiseFigures& f) { f.reversed_components = 1; },
      [](PromiseFigures& f) { f.off_box_edges = 1; },
      [](PromiseFigures& f) { f.topology = Verdict::kDifferent; },
      [](PromiseFigures& f) { f.topology = Verdict::kSingularIsovalue; },
      [](PromiseFigures& f) { f.crossing_pairs = 1; },
      [](PromiseFigures& f) { f.touching_pairs = 1; },
      [](PromiseFigures& f) { f.vertices_off = 1; },
      [](PromiseFigures& f) { f.mesh_off = 1; },
      [](PromiseFigures& f) { f.isosurface_off = 1; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    PromiseFigures figures = kept();
    faults[i](figures);
    EXPECT_EQ(broken_promises(figures, {}).size(), 1u) << i;
  }
}

TEST(Promise, NamesBoundAndWorst) {
  PromiseFigures figures = kept();
  figures.mesh_off = 3;
  figures.worst_mesh = 2.5;
  EXPECT_EQ(broken_promises(figures, {.max_distance = 2}).at(0),
            "3 places of the mesh are more than 2 voxel off the isosurface, the worst 2.500000");
}

}  // namespace
}  // namespace deliso
