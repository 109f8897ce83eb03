#include "surface/refinement_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "delaunay/base/box3.h"

namespace deliso {

namespace {

constexpr std::size_t kMostSlabs = 8;
// A plane may move by so much of a slab's work to either side of where it would be fair, to one of so many places.
constexpr double kFreedom = 0.125;
constexpr std::size_t kPlaces = 65;

std::size_t longest_axis(const RefinementMesh& mesh) {
  Box3 box;
  for (const RefinementMesh::Vertex& v : mesh.vertices) box.extend(v.point);
  const Vec3 size = box.size();
  return size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
}

// Work along an axis: how much lies below a place, by the middles of triangles.
class WorkAlong {
 public:
  WorkAlong(const RefinementMesh& mesh, std::span<const float> work, std::size_t axis) {
    spans_.reserve(work.size());
    for (std::uint32_t t = 0; t < work.size(); ++t) {
      const auto [a, b, c] = mesh.corner_points(mesh.triangles[t].corners);
      const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
      spans_.push_back({0.5 * low + 0.5 * high, low, high, 0, work[t]});
    }
    std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) {
      return std::tie(a.middle, a.low, a.work) < std::tie(b.middle, b.low, b.work);
    });
    // Every triangle costs a little, even when nothing is inserted.
    for (Span& span : spans_) span.below = total_ += kTriangle + span.work;
  }

  // Where the work below reaches a part of all.
  [[nodiscard]] double place_of(double part) const {
    const auto at = std::lower_bound(spans_.begin(), spans_.end(), part * total_,
                                     [](const Span& span, double below) { return span.below < below; });
    return at == spans_.end() ? spans_.back().middle : at->middle;
  }

  // Of places between `low` and `high` the one whose plane cuts through the least work, the nearest to `fair` of these.
  [[nodiscard]] double least_cut(double low, double fair, double high) const {
    std::array<double, kPlaces> cut{};
    const double step = (high - low) / (kPlaces - 1);
    if (!(step > 0)) return fair;
    for (const Span& span : spans_) {
      const double first = std::max(std::ceil((span.low - low) / step), 0.0);
      const double end = std::min(std::floor((span.high - low) / step) + 1, static_cast<double>(kPlaces));
      if (!(first < end)) continue;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(end); ++i) cut[i] += span.work;
    }
    std::size_t best = 0;
    const auto place = [&](std::size_t i) { return low + static_cast<double>(i) * step; };
    for (std::size_t i = 1; i < kPlaces; ++i) {
      const bool is_nearer = std::abs(place(i) - fair) < std::abs(place(best) - fair);
      if (cut[i] < cut[best] || (cut[i] == cut[best] && is_nearer)) best = i;
    }
    return place(best);
  }

 private:
  static constexpr double kTriangle = 0.5;  // in insertions

  struct Span {
    double middle, low, high;
    double below;
    float work;
  };
  std::vector<Span> spans_;
  double total_ = 0;
};

}  // namespace

std::vector<Slab> slabs_of_equal_work(const RefinementMesh& mesh, std::span<const float> work,
                                      std::size_t slab_triangles) {
  const std::size_t wanted = (mesh.triangles.size() + slab_triangles / 2) / slab_triangles;
  std::vector<Slab> slabs(std::clamp<std::size_t>(wanted, 1, kMostSlabs));
  if (slabs.size() == 1) return slabs;
  const std::size_t axis = longest_axis(mesh);
  const WorkAlong along(mesh, work, axis);
  const auto count = static_cast<double>(slabs.size());
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    slabs[k].axis = axis;
    if (k == 0) continue;
    const auto place = [&](double shift) { return along.place_of((static_cast<double>(k) + shift) / count); };
    slabs[k].low = slabs[k - 1].high = along.least_cut(place(-kFreedom), place(0), place(kFreedom));
  }
  return slabs;
}

}  // namespace deliso
