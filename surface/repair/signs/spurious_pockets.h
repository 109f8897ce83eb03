// Spurious pockets: small sets of tetrahedra whose sign the exact topology rules out.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/restricted/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The local extrema of the trilinear interpolant are samples. So every connected region above the isovalue contains a
// sample above it, and every region below contains one below. A small face-connected set of tetrahedra of one sign
// without a sample of that sign is therefore an artefact. Sets with ghosts or with more than a hundred tetrahedra are
// not examined.
class SpuriousPockets {
 public:
  // Keeps references. The same for any number of threads.
  SpuriousPockets(const SignedDelaunay& restricted, const ScalarGrid& grid, int threads = 1);

  // Finds the pockets for the present signs; examines only the surroundings of signs that have changed since the last
  // update.
  void update();
  // Updates the arrays after an exchange of points; call update() afterwards.
  void renew(const ExchangedPoints& exchanged);
  // Finds the pockets and flips the signs in them; returns their number. `restricted` is that of the constructor.
  std::int64_t flip(SignedDelaunay& restricted);
  [[nodiscard]] const std::vector<std::vector<TetId>>& pockets() const { return pockets_; }

 private:
  using Pocket = std::vector<TetId>;
  enum class State : std::uint8_t { kUnseen, kPocket, kExcluded };
  // The state of a search: what it has visited, and the set that it is flooding.
  struct Search {
    explicit Search(std::size_t slots) : state(slots, State::kUnseen) {}
    std::vector<State> state;  // by slot
    Pocket flood;
  };
  void search_all();
  bool floods_pocket(TetId seed, Search& search) const;
  [[nodiscard]] bool is_spurious(const Pocket& pocket) const;

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const ScalarGrid& grid_;
  int threads_;
  std::vector<std::uint8_t> signs_;  // by slot, as of the last update
  std::vector<TetId> renewed_;       // slots renewed since the last update
  std::vector<Pocket> pockets_;
};

}  // namespace deliso
