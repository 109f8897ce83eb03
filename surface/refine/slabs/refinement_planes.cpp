#include "surface/refine/slabs/refinement_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

constexpr std::size_t kMostSlabs = 10;
// A plane may deviate from equal shares by this fraction of a slab's work to either side; kPlaces positions are
// compared. The triangles that it cuts are refined in a seam first, so equal shares matter more than few cuts.
constexpr double kFreedom = 0.0625;
constexpr std::size_t kPlaces = 65;
// The margin of a seam around a coarse triangle, in lengths of the triangle along the axis.
constexpr double kMargin = 1;

std::size_t longest_axis(const RefinementMesh& mesh) {
  Box3 box;
  for (const RefinementMesh::Vertex& v : mesh.vertices) box.extend(v.point);
  const Vec3 size = box.size();
  return size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
}

// The distribution of work along an axis: how much lies below a coordinate, counted at the middles of triangles.
class WorkAlong {
 public:
  WorkAlong(const RefinementMesh& mesh, std::span<const float> work, std::size_t axis, int threads)
      : spans_(work.size()) {
    for_each_block(work.size(), threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        const auto [low, high] = mesh.extent_of(static_cast<std::uint32_t>(t), axis);
        spans_[t] = {0.5 * low + 0.5 * high, low, high, work[t]};
      }
    });
    fill_bins();
  }

  // The coordinate below which this fraction of all work lies.
  [[nodiscard]] double place_of(double part) const {
    const double wanted = part * bins_.back().below;
    const auto bin = std::lower_bound(bins_.begin() + 1, bins_.end() - 1, wanted,
                                      [](const Bin& one, double below) { return one.below < below; });
    std::vector<Span> spans;
    for (std::size_t i = (bin - 1)->end; i < bin->end; ++i) spans.push_back(spans_[by_bin_[i]]);
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
      return std::tie(a.middle, a.low, a.work) < std::tie(b.middle, b.low, b.work);
    });
    double below = (bin - 1)->below;
    for (const Span& span : spans) {
      below += span.all_work();
      if (!(below < wanted)) return span.middle;
    }
    return spans.back().middle;
  }

  // The coordinate between `low` and `high` whose plane cuts through the least work; of equals the one nearest to
  // `fair`.
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
    const auto place = [&](std::size_t i) { return std::min(low + static_cast<double>(i) * step, high); };
    for (std::size_t i = 1; i < kPlaces; ++i) {
      const bool is_nearer = std::abs(place(i) - fair) < std::abs(place(best) - fair);
      if (cut[i] < cut[best] || (cut[i] == cut[best] && is_nearer)) best = i;
    }
    return place(best);
  }

 private:
  static constexpr double kTriangle = 0.5;  // in insertions: every triangle costs a little, even without an insertion
  static constexpr std::size_t kBins = 4096;

  struct Span {
    double middle, low, high;
    float work;
    std::uint32_t bin = 0;

    [[nodiscard]] double all_work() const { return kTriangle + work; }
  };
  // The end of a bin's spans in by_bin_, and the work of these and of all bins below.
  struct Bin {
    std::size_t end = 0;
    double below = 0;
  };

  // Puts spans into bins by their middles, so that only the spans of one bin have to be sorted for a query.
  void fill_bins() {
    const auto [first, last] = std::minmax_element(spans_.begin(), spans_.end(),
                                                   [](const Span& a, const Span& b) { return a.middle < b.middle; });
    const double low = first->middle, size = last->middle - low;
    const double bins_per_unit = size > 0 ? kBins / size : 0;
    for (Span& span : spans_) {
      span.bin = static_cast<std::uint32_t>(std::min((span.middle - low) * bins_per_unit, kBins - 1.0));
      ++bins_[span.bin + 1].end;
      bins_[span.bin + 1].below += span.all_work();
    }
    for (std::size_t i = 1; i < bins_.size(); ++i) {
      bins_[i].end += bins_[i - 1].end;
      bins_[i].below += bins_[i - 1].below;
    }
    std::vector<std::size_t> next(kBins);
    for (std::size_t i = 0; i < kBins; ++i) next[i] = bins_[i].end;
    by_bin_.resize(spans_.size());
    for (std::uint32_t i = 0; i < spans_.size(); ++i) by_bin_[next[spans_[i].bin]++] = i;
  }

  std::vector<Span> spans_;
  std::vector<std::uint32_t> by_bin_;                    // spans in the order of their bins
  std::vector<Bin> bins_ = std::vector<Bin>(kBins + 1);  // bin 0 is empty
};

using Extent = RefinementMesh::Extent;

std::vector<Extent> extents_of_coarse(const RefinementMesh& mesh, std::size_t axis, int threads) {
  return collect_in_blocks<Extent>(mesh.triangles.size(), threads, [&](std::size_t t, std::vector<Extent>& found) {
    if (mesh.triangles[t].is_coarse()) found.push_back(mesh.extent_of(static_cast<std::uint32_t>(t), axis));
  });
}

double middle_of(const Slab& slab) { return 0.5 * slab.low + 0.5 * slab.high; }

}  // namespace

std::vector<Slab> slabs_of_equal_work(const RefinementMesh& mesh, std::span<const float> work,
                                      std::size_t slab_triangles, int threads) {
  std::size_t wanted = (mesh.triangles.size() + slab_triangles / 2) / slab_triangles;
  if (wanted > 1) wanted += wanted % 2;  // an even number, for two threads
  std::vector<Slab> slabs(std::clamp<std::size_t>(wanted, 1, kMostSlabs));
  if (slabs.size() == 1) return slabs;
  const std::size_t axis = longest_axis(mesh);
  const WorkAlong along(mesh, work, axis, threads);
  const auto count = static_cast<double>(slabs.size());
  run_tasks(slabs.size() - 1, threads, [&](std::size_t k) {
    const auto place = [&](double shift) { return along.place_of((static_cast<double>(k + 1) + shift) / count); };
    slabs[k].high = slabs[k + 1].low = along.least_cut(place(-kFreedom), place(0), place(kFreedom));
  });
  for (Slab& slab : slabs) slab.axis = axis;
  return slabs;
}

std::vector<Slab> most_work_first(std::vector<Slab> slabs, const RefinementMesh& mesh, std::span<const float> work) {
  std::vector<std::pair<double, Slab>> by_work;  // in the order of places
  by_work.reserve(slabs.size());
  for (const Slab& slab : slabs) by_work.emplace_back(0, slab);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.triangles[t].is_coarse()) continue;
    const Extent extent = mesh.extent_of(t, slabs.front().axis);
    const double middle = 0.5 * extent.low + 0.5 * extent.high;
    std::size_t k = 0;
    while (k + 1 < by_work.size() && middle > by_work[k].second.high) ++k;
    by_work[k].first += work[t];
  }
  std::stable_sort(by_work.begin(), by_work.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < slabs.size(); ++k) slabs[k] = by_work[k].second;
  return slabs;
}

std::vector<Slab> seams_between(const std::vector<Slab>& slabs, const RefinementMesh& mesh, int threads) {
  const std::vector<Extent> coarse = extents_of_coarse(mesh, slabs.front().axis, threads);
  std::vector<Slab> seams;
  for (std::size_t k = 0; k + 1 < slabs.size(); ++k) {
    const double plane = slabs[k].high;
    Slab seam{slabs[k].axis, plane, plane};
    // The new triangles that replace a coarse triangle must lie in the seam, too.
    for (const Extent& extent : coarse) {
      if (!extent.holds(plane)) continue;
      const double margin = kMargin * (extent.high - extent.low);
      seam.low = std::min(seam.low, extent.low - margin);
      seam.high = std::max(seam.high, extent.high + margin);
    }
    seam.low = std::max(seam.low, middle_of(slabs[k]));
    seam.high = std::min(seam.high, middle_of(slabs[k + 1]));
    seams.push_back(seam);
  }
  return seams;
}

}  // namespace deliso
