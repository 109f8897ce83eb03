// An axis-aligned box.
#pragma once

#include <algorithm>
#include <limits>

#include "delaunay/base/vec3.h"

namespace deliso {

// The box [low, high]. A default box is empty: extend it by points.
struct Box3 {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  void extend(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] Vec3 size() const { return high - low; }
  [[nodiscard]] double diagonal() const { return norm(size()); }
  [[nodiscard]] double smallest_side() const { return std::min({size().x, size().y, size().z}); }
  [[nodiscard]] bool contains(const Vec3& p) const {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
  }
  // Whether the boxes have a point in common, faces included.
  [[nodiscard]] bool meets(const Box3& b) const {
    // All six comparisons are made: which one fails is unpredictable, so a branch on each would cost more.
    const auto within = [](double a, double c) { return static_cast<unsigned>(a <= c); };
    return (within(low.x, b.high.x) & within(b.low.x, high.x) & within(low.y, b.high.y) & within(b.low.y, high.y) &
            within(low.z, b.high.z) & within(b.low.z, high.z)) != 0;
  }
  // The point of the box nearest to p.
  [[nodiscard]] Vec3 clamp(const Vec3& p) const {
    return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
  }
};

}  // namespace deliso
