#include "volume/filters/gaussian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/parallel.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

namespace {

// Weights of the distances 0, 1, ..., radius; with those of the negative distances they add up to 1.
std::vector<double> half_kernel(double sigma) {
  constexpr double kCutOff = 4;  // sigmas
  if (!(sigma > 0)) return {1};
  const auto radius = static_cast<std::size_t>(std::max(1.0, std::ceil(kCutOff * sigma)));
  std::vector<double> weights(radius + 1);
  double sum = 0;
  for (std::size_t d = 0; d <= radius; ++d) {
    const double x = static_cast<double>(d) / sigma;
    weights[d] = std::exp(-x * x / 2);
    sum += d == 0 ? weights[d] : 2 * weights[d];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Convolves a row of `count` elements, each of them `width` numbers next to each other.
void convolve(std::span<const double> from, std::span<double> to, std::size_t count, std::size_t width,
              const std::vector<double>& weights) {
  const auto element = [&](std::size_t i) { return from.data() + i * width; };
  for (std::size_t i = 0; i < count; ++i) {
    double* sum = to.data() + i * width;
    const double* middle = element(i);
    for (std::size_t x = 0; x < width; ++x) sum[x] = weights[0] * middle[x];
    for (std::size_t d = 1; d < weights.size(); ++d) {
      const double* before = element(i < d ? 0 : i - d);
      const double* after = element(std::min(i + d, count - 1));
      for (std::size_t x = 0; x < width; ++x) sum[x] += weights[d] * (before[x] + after[x]);
    }
  }
}

// Slices of a grid along z, each convolved along x and y when it is needed, in a ring of as many as one sum needs.
template <class Sample>
class SmoothedSlices {
 public:
  SmoothedSlices(const SampleArray<Sample>& samples, const Dims& dims, const std::vector<double>& along_x,
                 const std::vector<double>& along_y, std::size_t slices)
      : samples_(samples),
        nx_(static_cast<std::size_t>(dims[0])),
        ny_(static_cast<std::size_t>(dims[1])),
        along_x_(along_x),
        along_y_(along_y),
        ring_(slices),
        holds_(slices, kNone),
        work_(nx_ * ny_) {}

  // Slice k. Valid until the slice that is as many above it as the ring has slices is asked for.
  std::span<const double> slice(std::size_t k) {
    std::vector<double>& slot = ring_[k % ring_.size()];
    if (holds_[k % ring_.size()] == k) return slot;
    holds_[k % ring_.size()] = k;
    slot.resize(nx_ * ny_);
    const Sample* first = samples_.data() + k * nx_ * ny_;
    std::copy_n(first, nx_ * ny_, slot.begin());
    for (std::size_t j = 0; j < ny_; ++j) {
      convolve(std::span(slot).subspan(j * nx_, nx_), std::span(work_).subspan(j * nx_, nx_), nx_, 1, along_x_);
    }
    convolve(work_, slot, ny_, nx_, along_y_);
    return slot;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  const SampleArray<Sample>& samples_;
  std::size_t nx_, ny_;
  const std::vector<double>&along_x_, &along_y_;
  std::vector<std::vector<double>> ring_;
  std::vector<std::size_t> holds_;  // the slice in each slot of the ring
  std::vector<double> work_;
};

template <class Out, class Sample>
std::vector<Out> smoothed_samples(const SampleArray<Sample>& samples, const Dims& dims, const Vec3& sigma,
                                  int threads) {
  const std::vector<double> x = half_kernel(sigma.x), y = half_kernel(sigma.y), z = half_kernel(sigma.z);
  const std::size_t area = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
  const auto nz = static_cast<std::size_t>(dims[2]);
  std::vector<Out> out(samples.size());
  // Each task makes a few slices, and those around them for itself; a slice is the same whoever makes it.
  const std::size_t at_once = std::max<std::size_t>(16, 4 * z.size());
  run_tasks((nz + at_once - 1) / at_once, threads, [&](std::size_t task) {
    SmoothedSlices<Sample> slices(samples, dims, x, y, 2 * z.size() - 1);
    std::vector<double> sum(area);
    for (std::size_t k = task * at_once; k < std::min(nz, (task + 1) * at_once); ++k) {
      const std::span<const double> middle = slices.slice(k);
      for (std::size_t i = 0; i < area; ++i) sum[i] = z[0] * middle[i];
      for (std::size_t d = 1; d < z.size(); ++d) {
        const std::span<const double> before = slices.slice(k < d ? 0 : k - d);
        const std::span<const double> after = slices.slice(std::min(k + d, nz - 1));
        for (std::size_t i = 0; i < area; ++i) sum[i] += z[d] * (before[i] + after[i]);
      }
      std::transform(sum.begin(), sum.end(), out.begin() + static_cast<std::ptrdiff_t>(k * area),
                     [](double value) { return static_cast<Out>(value); });
    }
  });
  return out;
}

}  // namespace

ScalarGrid smoothed(const ScalarGrid& grid, const Vec3& sigma, int threads) {
  constexpr double kLargest = 1000;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (sigma[axis] >= 0 && sigma[axis] <= kLargest) continue;
    throw InputError("the standard deviation to smooth with is " + shortest_text(sigma[axis]) +
                     " spacings along an axis: expected 0 to " + shortest_text(kLargest));
  }
  Samples samples = visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& s) {
    // Floats also hide what rounding leaves of sums that are equal but for their order, as in masks with a symmetry.
    using Out =
        std::conditional_t<std::is_same_v<Sample, double> || std::is_same_v<Sample, std::int32_t>, double, float>;
    return Samples(SampleArray<Out>(smoothed_samples<Out>(s, grid.dims(), sigma, threads)));
  });
  return {grid.dims(), std::move(samples), grid.spacing(), grid.origin()};
}

Vec3 sigma_in_spacings(double sigma, const Vec3& spacing) {
  const double voxel = std::min({spacing.x, spacing.y, spacing.z});
  return {sigma * (voxel / spacing.x), sigma * (voxel / spacing.y), sigma * (voxel / spacing.z)};
}

}  // namespace deliso
