// Volumes closed along their box: where the surface runs, and its exact topology.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/filters/closing.h"
#include "volume/regular_isovalue.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

// How far outside the box the surface crosses a grid edge, in spacings; every edge into the layer from a sample of the
// solid must be crossed there, and no other.
void expect_on_the_box(const ScalarGrid& grid, double isovalue, Inside inside) {
  const ClosedGrid closed = closed_grid(grid, isovalue, inside);
  const auto [nx, ny, nz] = grid.dims();
  ASSERT_EQ(closed.grid.dims(), (Dims{nx + 2, ny + 2, nz + 2}));
  ASSERT_TRUE(closed.grid.walls());
  EXPECT_EQ(closed.grid.walls()->low, grid.box().low);
  EXPECT_EQ(closed.grid.walls()->high, grid.box().high);
  const double layer = closed.grid.at(0, 0, 0), used = closed.isovalue;
  EXPECT_TRUE(std::isfinite(layer));
  EXPECT_EQ(layer < used, inside == Inside::kAbove);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const double sample = closed.grid.at(i + 1, j + 1, k + 1);
        ASSERT_EQ(sample, grid.at(i, j, k));
        ASSERT_NE(sample, used);
        const bool is_solid = (sample > used) == (inside == Inside::kAbove);
        if (is_solid) {
          ASSERT_LE((sample - used) / (sample - layer), 0x1p-29);
        }
      }
}

TEST(Closing, RunsAlongTheFacesOfTheBox) {
  Rng rng(1);
  std::vector<std::uint8_t> bytes(120);
  std::vector<std::int32_t> integers(120);
  std::vector<float> floats(120);
  std::vector<double> doubles(120);
  for (std::size_t i = 0; i < 120; ++i) {
    bytes[i] = static_cast<std::uint8_t>(rng.below(256));
    integers[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(rng.below(4000000000u)) - 2000000000);
    floats[i] = static_cast<float>(rng.below(1000)) * 1e33f;
    doubles[i] = static_cast<double>(rng.below(1000)) * 1e-200;
  }
  const Dims dims{4, 5, 6};
  for (const Inside inside : {Inside::kAbove, Inside::kBelow}) {
    expect_on_the_box(ScalarGrid(dims, bytes, {1, 2, 3}, {0.1, 0.7, -9}), 100, inside);
    expect_on_the_box(ScalarGrid(dims, integers), 12345, inside);
    expect_on_the_box(ScalarGrid(dims, floats), 5e35, inside);
    expect_on_the_box(ScalarGrid(dims, doubles), 3e-198, inside);
    // The largest that can be closed.
    std::vector<double> largest(doubles.size(), -1e290);
    largest[largest.size() / 2] = 1e290;
    expect_on_the_box(ScalarGrid(dims, largest), 0.99e290, inside);
  }
  EXPECT_EQ(closed_grid(ScalarGrid(dims, bytes), 100, Inside::kAbove).grid.type_name(), "f32");
  EXPECT_EQ(closed_grid(ScalarGrid(dims, floats), 5e35, Inside::kAbove).grid.type_name(), "f64");
}

TEST(Closing, OfAVolumeThatIsAllInsideIsItsBox) {
  const ScalarGrid ones({3, 4, 5}, std::vector<std::uint8_t>(60, 1));
  for (const double isovalue : {0.5, 1.0, -1e9}) {
    EXPECT_TRUE(has_solid(ones, isovalue, Inside::kAbove));
    expect_on_the_box(ones, isovalue, Inside::kAbove);
    const ClosedGrid closed = closed_grid(ones, isovalue, Inside::kAbove);
    const IsosurfaceTopology topology = exact_topology(closed.grid, closed.isovalue);
    EXPECT_EQ(topology.components, (std::vector<ComponentTopology>{{2, 0}})) << isovalue;
  }
  EXPECT_FALSE(has_solid(ones, 1.5, Inside::kAbove));
  EXPECT_TRUE(has_solid(ones, 1.5, Inside::kBelow));
  EXPECT_FALSE(has_solid(ones, 1.0, Inside::kBelow));
}

// The two sides of one isosurface: their closed solids fill the box together, so that the Euler characteristics of all
// boundaries add up to that of the box and twice the isosurface's, whose boundary loops are shared.
TEST(Closing, OfBothSidesFillTheBox) {
  for (const char* name : {"gyroid", "plane", "sheets", "torus"}) {
    const ScalarGrid grid = generate_field(name, 12);
    const double isovalue = find_analytic_field(name).isovalue;
    const auto euler = [](const ScalarGrid& g, double value) {
      std::int64_t sum = 0;
      for (const ComponentTopology& c : exact_topology(g, value).components) {
        EXPECT_TRUE(c.boundary_loops == 0 || !g.walls());
        sum += c.euler_characteristic;
      }
      return sum;
    };
    const ClosedGrid above = closed_grid(grid, isovalue, Inside::kAbove);
    const ClosedGrid below = closed_grid(grid, isovalue, Inside::kBelow);
    EXPECT_EQ(euler(above.grid, above.isovalue) + euler(below.grid, below.isovalue),
              2 + 2 * euler(grid, regular_isovalue(grid, isovalue)))
        << name;
  }
}

}  // namespace
}  // namespace deliso
