// An order of things in which neighbours in space are mostly neighbours in memory: that of the leaves of a tree made by
// repeated halving.
//
// The things are split along the longest side of their centres' box, then the parts again, down to leaves of eight.
// Every left part has as many leaves as the largest power of two below the number of all its leaves. So eight leaves
// that begin at a multiple of eight form a subtree, and so on upward. The extents of all subtrees follow from the
// number of things.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

inline constexpr std::uint32_t kThingsPerLeaf = 8;

// A thing and its centre, in steps of a lattice.
struct LatticePlace {
  std::array<std::int32_t, 3> at{};
  std::uint32_t thing = 0;
};

// A lattice on a box with 2^30 steps along its longest side.
class CentreLattice {
 public:
  explicit CentreLattice(const Box3& box);
  // Precondition: p in the box.
  [[nodiscard]] LatticePlace place(const Vec3& p, std::size_t thing) const {
    return {{step(p.x - low_.x), step(p.y - low_.y), step(p.z - low_.z)}, static_cast<std::uint32_t>(thing)};
  }

 private:
  [[nodiscard]] std::int32_t step(double offset) const {
    const double steps = offset * steps_per_unit_;
    return steps > 0 ? static_cast<std::int32_t>(steps < kMostSteps ? steps : kMostSteps) : 0;
  }

  static constexpr double kMostSteps = 0x3FFFFFFF;
  Vec3 low_;
  double steps_per_unit_ = 0;
};

// How many of `count` things the left part gets. Precondition: there is more than one leaf.
std::uint32_t left_half(std::uint32_t count);

// The things in the order of the leaves, the same for any number of threads. centre_of(thing) gives the point from
// which its position was made: things crowded into few lattice steps get a finer lattice of their own.
std::vector<std::uint32_t> kd_order(std::vector<LatticePlace> places,
                                    const std::function<Vec3(std::uint32_t)>& centre_of, int threads);

}  // namespace deliso
