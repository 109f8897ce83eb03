// Whether a component of a patch is large. Goes from star to star, which is fast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/shape/patch.h"

namespace deliso {

class ComponentSize {
 public:
  // Whether more than so many triangles hang together with one.
  [[nodiscard]] bool exceeds(const Patch& patch, std::uint32_t triangle, std::size_t most) {
    ++search_;
    seen_.resize(patch.triangle_count(), 0);
    found_.assign(1, triangle);
    seen_[triangle] = search_;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      for (const std::uint32_t v : patch.corners(found_[i])) {
        for (const std::uint32_t t : patch.star(v)) {
          if (seen_[t] == search_) continue;
          seen_[t] = search_;
          found_.push_back(t);
        }
        if (found_.size() > most) return true;
      }
    }
    return false;
  }

 private:
  std::vector<std::uint32_t> found_;
  std::vector<std::uint32_t> seen_;  // of each triangle: the latest search that came to it
  std::uint32_t search_ = 0;
};

}  // namespace deliso
