// The samples of repair's triangulation: free points of the surface, and lattice samples in refined cells.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

struct RepairSample {
  Vec3 point;             // in mesh space
  std::uint64_t key = 0;  // the key of a lattice sample; 0 for a free sample; kStays for one that no cell replaces
};
inline constexpr std::uint64_t kStays = ~std::uint64_t{0};

// Samples to exchange.
struct Resampling {
  std::vector<VertexId> leaving;  // ascending
  std::vector<RepairSample> coming;

  [[nodiscard]] std::vector<Vec3> coming_points() const;
};

// The samples are the vertices of the triangulation except virtual ones, in the same order. After every change of the
// triangulation one of the functions below must be called.
class RepairSamples {
 public:
  // All vertices become free samples, but those at the `fixed` points stay where cells are refined, too.
  RepairSamples(const SignedDelaunay& restricted, std::span<const Vec3> fixed);

  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] std::vector<Vec3> points() const;

  // The exchange that the cells refined since the last one need: free samples in them leave, and lattice samples come.
  // Free samples on the box stay, because they lie on its boundary curves. One of the two functions at the end must
  // follow.
  [[nodiscard]] Resampling resampling(const CellLevels& cell_levels, const SampleLattice& lattice,
                                      const Isosurface& isosurface);
  // Whether so few samples change that it is better to exchange them in the present triangulation.
  [[nodiscard]] bool changes_few(const Resampling& resampling) const;

  // Call after the triangulation was changed in place; vertex_of is that of ExchangedPoints.
  void exchange(const Resampling& resampling, std::span<const VertexId> vertex_of);
  // Call before a new triangulation is built of points(); the new samples come last.
  void replace(const Resampling& resampling);
  // Call after it was built; vertex_of gives the vertices of the samples.
  void take_vertices(std::span<const VertexId> vertex_of);

 private:
  void remove(std::span<const VertexId> leaving);
  // The cells whose levels have changed since the last call, ascending, with their levels before (0: none).
  std::vector<std::pair<CellName, int>> changed_cells(const CellLevels& cell_levels);
  // The lattice samples of these cells that have not come before, in the order of their keys.
  std::vector<RepairSample> new_samples(const CellLevels& cell_levels, const SampleLattice& lattice,
                                        std::span<const std::pair<CellName, int>> cells, const Vec3& step);

  std::vector<RepairSample> samples_;
  std::vector<RepairSample> hidden_;               // lattice samples that equal a vertex: they come if it leaves
  std::vector<std::uint64_t> keys_;                // of all lattice samples so far, ascending
  std::vector<std::pair<CellName, int>> sampled_;  // the levels at the last resampling, by cell
};

}  // namespace deliso
