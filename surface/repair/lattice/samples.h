// The samples of repair's triangulation: free points of the surface, and lattice samples in raised cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

struct RepairSample {
  Vec3 point;             // in mesh space
  std::uint64_t key = 0;  // of a lattice sample; 0 for a free one
};

// Samples to exchange.
struct Resampling {
  std::vector<VertexId> leaving;  // ascending
  std::vector<RepairSample> coming;

  [[nodiscard]] std::vector<Vec3> coming_points() const;
};

// Always the vertices of the triangulation, in order, but for virtual ones, once the calls below have told of a change.
class RepairSamples {
 public:
  // All of them free.
  explicit RepairSamples(const SignedDelaunay& restricted);

  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] std::vector<Vec3> points() const;

  // What raised cells ask for: free samples in them go, lattice samples come. Free samples on the box stay: they carry
  // its boundary curves.
  [[nodiscard]] Resampling resampling(const CellLevels& raised, const SampleLattice& lattice,
                                      const Isosurface& isosurface) const;
  // Whether so few samples change that they are best exchanged in the triangulation as it is.
  [[nodiscard]] bool changes_few(const Resampling& resampling) const;

  // The triangulation was changed in place; vertex_of: of each that comes (ExchangedPoints).
  void exchange(const Resampling& resampling, std::span<const VertexId> vertex_of);
  // A triangulation is to be made of points(), with those that come at the end;
  void replace(const Resampling& resampling);
  // it was made, and has these vertices for them.
  void take_vertices(std::span<const VertexId> vertex_of);

 private:
  void remove(std::span<const VertexId> leaving);

  std::vector<RepairSample> samples_;
};

}  // namespace deliso
