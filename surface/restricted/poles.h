// Poles (Amenta and Bern; Dey and Levine, section 3.2): the scale of the surface at each vertex.
#pragma once

#include <vector>

#include "surface/base/parameters.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The pole height of every vertex, in mesh-space units. The umbrella of a vertex splits its Voronoi cell in two; on
// each side the pole is the Voronoi vertex farthest from the vertex, and the pole height is the smaller of the two
// distances (or, for comparison, the larger or their mean). The signs of the tetrahedra tell the sides apart. A side on
// which the cell is unbounded counts as infinite (but for vertices on the box, whose cells always leave it); when both
// are, the height is the diagonal of the box.
std::vector<double> compute_poles(const SignedDelaunay& restricted, PoleHeight rule = PoleHeight::kNearer);
// The same where only those of the wanted vertices matter; the others have any height; on several threads.
std::vector<double> compute_poles(const SignedDelaunay& restricted, const std::vector<bool>& wanted, PoleHeight rule,
                                  int threads);

// Pole heights (the nearer pole) for signs that change and points that are exchanged: those of vertices around which
// nothing has changed since the last time are known.
class KnownPoles {
 public:
  // Keeps a reference.
  explicit KnownPoles(const SignedDelaunay& restricted) : restricted_(restricted) {}

  void renew(const ExchangedPoints& exchanged);
  // For the signs as they stand; of the wanted vertices, the others have any height.
  const std::vector<double>& heights(const std::vector<bool>& wanted, int threads);

 private:
  void forget_around(TetId t);

  const SignedDelaunay& restricted_;
  std::vector<std::uint8_t> signs_;  // by slot, as of the last time; empty when there was none
  std::vector<double> heights_;
  std::vector<bool> is_known_;
};

}  // namespace deliso
