// Signs without foundation: small pockets of tetrahedra that the exact topology rules out.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The trilinear interpolant has its local extrema at samples only; so every connected region above the isovalue holds a
// sample above it, and every region below holds one below. A small face-connected set of tetrahedra of one sign that
// holds no sample of that sign is therefore an artefact. Sets with ghosts or more than a hundred tetrahedra are left
// alone.
class UnfoundedPockets {
 public:
  // Keeps references.
  UnfoundedPockets(const SignedDelaunay& restricted, const ScalarGrid& grid);

  // Finds the sets for the signs as they stand; looks only around those that have changed since the last update.
  void update();
  // Takes account of an exchange of points; update() is to follow.
  void renew(const ExchangedPoints& exchanged);
  // Finds the sets and turns the signs in them over; returns how many there were. `restricted` is that of the
  // constructor.
  std::int64_t overturn(SignedDelaunay& restricted);
  [[nodiscard]] const std::vector<std::vector<TetId>>& pockets() const { return pockets_; }

 private:
  enum class State : std::uint8_t { kUnseen, kPocket, kLeftAlone };
  void look_at(TetId seed);

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const ScalarGrid& grid_;
  std::vector<std::uint8_t> signs_;  // by slot, as of the last update
  std::vector<TetId> renewed_;       // since the last update
  std::vector<State> state_;
  std::vector<TetId> flood_;
  std::vector<std::vector<TetId>> pockets_;
};

}  // namespace deliso
