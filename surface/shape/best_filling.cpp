#include "surface/shape/best_filling.h"

#include <algorithm>
#include <utility>

#include "surface/mesh/triangle_shape.h"

namespace deliso {

void BestFilling::find(std::span<const Vec3> polygon, std::size_t i, std::size_t j) {
  double& best = best_[i * size_ + j];
  best = 0;
  middle_[i * size_ + j] = i + 1;
  for (std::size_t k = i + 1; k < j; ++k) {
    const double bound = std::min(best_[i * size_ + k], best_[k * size_ + j]);
    if (bound <= best) continue;
    const double quality = std::min(bound, sine_of_least_angle(polygon[i], polygon[k], polygon[j]));
    if (quality <= best) continue;
    best = quality;
    middle_[i * size_ + j] = k;
  }
}

std::vector<std::array<std::size_t, 3>> BestFilling::triangles() const {
  std::vector<std::array<std::size_t, 3>> found;
  std::vector<std::pair<std::size_t, std::size_t>> left = {{0, size_ - 1}};
  while (!left.empty()) {
    const auto [i, j] = left.back();
    left.pop_back();
    if (j < i + 2) continue;
    const std::size_t k = middle_[i * size_ + j];
    found.push_back({i, k, j});
    left.emplace_back(k, j);
    left.emplace_back(i, k);
  }
  return found;
}

}  // namespace deliso
