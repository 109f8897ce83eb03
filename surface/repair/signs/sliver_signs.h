// Signs of tetrahedra that are flat but for rounding: they must not fold the surface back on itself.
#pragma once

#include <vector>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// Where the isosurface is plane, as that of a mask is, samples lie in one plane, and often on one circle, but for the
// last bits of their coordinates; then tetrahedra of four of them have next to no height. Where their circumcenters and
// centroids lie is a matter of rounding, and so are their signs. With the wrong ones the restricted facets pass through
// a layer of such tetrahedra not once but three times: a fold by half a turn, whose triangles are apart only as long as
// nobody rounds their corners again. So flat tetrahedra take those signs with which the restricted facets have the
// least area; where that leaves a choice, they keep their own.
class SliverSigns {
 public:
  // Keeps a reference. The same for any number of threads.
  explicit SliverSigns(const SignedDelaunay& restricted, int threads = 1);

  // Takes account of an exchange of points.
  void renew(const ExchangedPoints& exchanged);
  // Gives the flat tetrahedra such signs, the others being as they are. `restricted` is that of the constructor.
  void settle(SignedDelaunay& restricted) const;
  // The flat ones, ascending.
  [[nodiscard]] const std::vector<TetId>& tets() const { return flat_; }

 private:
  void find_layers();

  const SignedDelaunay& restricted_;
  std::vector<TetId> flat_;
  std::vector<std::vector<TetId>> layers_;  // sets that hang together over common facets, each ascending
};

}  // namespace deliso
