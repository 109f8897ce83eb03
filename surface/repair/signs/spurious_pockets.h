// Signs without foundation: small pockets of tetrahedra that the exact topology rules out.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/restricted/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The trilinear interpolant has its local extrema at samples only; so every connected region above the isovalue holds a
// sample above it, and every region below holds one below. A small face-connected set of tetrahedra of one sign that
// holds no sample of that sign is therefore an artefact. Sets with ghosts or more than a hundred tetrahedra are left
// alone.
class SpuriousPockets {
 public:
  // Keeps references. The same for any number of threads.
  SpuriousPockets(const SignedDelaunay& restricted, const ScalarGrid& grid, int threads = 1);

  // Finds the sets for the signs as they stand; looks only around those that have changed since the last update.
  void update();
  // Takes account of an exchange of points; update() is to follow.
  void renew(const ExchangedPoints& exchanged);
  // Finds the sets and turns the signs in them over; returns how many there were. `restricted` is that of the
  // constructor.
  std::int64_t overturn(SignedDelaunay& restricted);
  [[nodiscard]] const std::vector<std::vector<TetId>>& pockets() const { return pockets_; }

 private:
  using Pocket = std::vector<TetId>;
  enum class State : std::uint8_t { kUnseen, kPocket, kLeftAlone };
  // What one look has seen so far, and what it is flooding.
  struct Look {
    explicit Look(std::size_t slots) : state(slots, State::kUnseen) {}
    std::vector<State> state;  // by slot
    Pocket flood;
  };
  void look_everywhere();
  bool floods_pocket(TetId seed, Look& look) const;
  [[nodiscard]] bool is_unfounded(const Pocket& pocket) const;

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const ScalarGrid& grid_;
  int threads_;
  std::vector<std::uint8_t> signs_;  // by slot, as of the last update
  std::vector<TetId> renewed_;       // since the last update
  std::vector<Pocket> pockets_;
};

}  // namespace deliso
