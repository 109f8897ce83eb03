// Poles (Amenta and Bern; Dey and Levine, section 3.2): the scale of the surface at each vertex.
#pragma once

#include <vector>

#include "surface/base/parameters.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The pole height of every vertex, in mesh-space units. The umbrella of a vertex splits its Voronoi cell in two. On
// each side the pole is the Voronoi vertex farthest from the vertex. The pole height is the smaller of the two
// distances (or, for comparison, the larger or their mean). The signs of the tetrahedra tell which side a Voronoi
// vertex is on. No distance counts as more than the diagonal of the box, and a side on which the cell is unbounded
// counts as that (except at vertices on the box, whose cells are always unbounded: there such a side has its bounded
// Voronoi vertices alone). A side without a Voronoi vertex leaves the height to the other.
std::vector<double> compute_poles(const SignedDelaunay& restricted, PoleHeight rule = PoleHeight::kNearer);
// The same when only the wanted vertices matter, on several threads. The heights of the others are unspecified.
std::vector<double> compute_poles(const SignedDelaunay& restricted, const std::vector<bool>& wanted, PoleHeight rule,
                                  int threads);

// Pole heights (of the nearer pole) while signs change and points are exchanged. The height of a vertex is computed
// anew only if something around it has changed since the last time.
class KnownPoles {
 public:
  // Keeps a reference.
  explicit KnownPoles(const SignedDelaunay& restricted) : restricted_(restricted) {}

  void renew(const ExchangedPoints& exchanged);
  // The heights for the present signs. Only those of the wanted vertices are specified.
  const std::vector<double>& heights(const std::vector<bool>& wanted, int threads);

 private:
  void forget_around(TetId t);

  const SignedDelaunay& restricted_;
  std::vector<std::uint8_t> signs_;  // by slot, as of the last call; empty before the first
  std::vector<double> heights_;
  std::vector<bool> is_known_;
};

}  // namespace deliso
