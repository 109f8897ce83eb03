#include "experiments/pictures/picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <thread>
#include <vector>

#include "delaunay/base/parallel.h"
#include "experiments/pictures/lighting.h"

namespace deliso {
namespace {

// What one ray has found, in the camera's frame.
struct Sample {
  std::array<float, 3> point{};
  std::array<float, 3> normal{};
  float line = 0;  // how much of it an edge covers
  bool seen = false;
  bool outside = true;
};

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3 doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

// Counts rows of a half of the work, on all threads, and tells of them on its own.
class RowProgress {
 public:
  RowProgress(const PictureOptions& options, std::int32_t rows, double from)
      : options_(options), rows_(rows), from_(from) {}
  void done() {
    const std::int32_t count = ++done_;
    if (!options_.progress || std::this_thread::get_id() != own_) return;
    options_.progress(from_ + 0.5 * static_cast<double>(count) / static_cast<double>(rows_));
  }

 private:
  const PictureOptions& options_;
  std::int32_t rows_;
  double from_;
  std::atomic<std::int32_t> done_{0};
  std::thread::id own_ = std::this_thread::get_id();
};

// The rays of a picture: samples^2 per pixel, on a regular lattice.
class SamplePlane {
 public:
  SamplePlane(const Shape& shape, const Box3& kept, const Camera& camera, const PictureOptions& options)
      : shape_(shape),
        kept_(kept),
        camera_(camera),
        options_(options),
        width_(camera.width() * options.samples),
        height_(camera.height() * options.samples),
        samples_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
    RowProgress progress(options, height_, 0);
    run_tasks(static_cast<std::size_t>(height_), options.threads, [&](std::size_t i) {
      const auto row = static_cast<std::int32_t>(i);
      for (std::int32_t column = 0; column < width_; ++column) cell(column, row) = traced(column, row);
      progress.done();
    });
  }

  [[nodiscard]] const Sample& at(std::int32_t column, std::int32_t row) const {
    return samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(column)];
  }
  [[nodiscard]] bool holds(std::int32_t column, std::int32_t row) const {
    return column >= 0 && row >= 0 && column < width_ && row < height_;
  }
  [[nodiscard]] bool shows_anything() const {
    return std::any_of(samples_.begin(), samples_.end(), [](const Sample& sample) { return sample.seen; });
  }
  [[nodiscard]] Line ray(std::int32_t column, std::int32_t row) const {
    return camera_.ray((column + 0.5) / options_.samples, (row + 0.5) / options_.samples);
  }

 private:
  Sample& cell(std::int32_t column, std::int32_t row) { return const_cast<Sample&>(at(column, row)); }

  [[nodiscard]] Sample traced(std::int32_t column, std::int32_t row) const {
    Sample sample;
    const Line line = ray(column, row);
    const std::optional<RayPart> part = part_in_box(line, kept_);
    if (!part) return sample;
    const auto point = shape_.first_hit(line, std::max(part->first, camera_.first_t()), part->last);
    if (!point) return sample;
    sample.seen = true;
    sample.outside = point->outside;
    sample.point = floats(camera_.in_frame(line.at(point->t)));
    sample.normal = floats(camera_.turned(point->normal));
    if (options_.line_width > 0) sample.line = static_cast<float>(line_cover(*point, column, row));
    return sample;
  }

  // The fraction of the sample's own square that a line covers. Where triangles are hardly larger than the line is
  // wide, lines get lighter, so that a fine mesh is grey and not black.
  [[nodiscard]] double line_cover(const SurfacePoint& point, std::int32_t column, std::int32_t row) const {
    constexpr double kWellSeen = 9;  // widths of the line in a mean edge
    const double samples = options_.samples;
    const double away = shape_.edge_distance(point.element, camera_, (column + 0.5) / samples, (row + 0.5) / samples);
    const double cover = std::clamp((0.5 * options_.line_width - away) * samples + 0.5, 0.0, 1.0);
    if (cover == 0) return 0;
    const double size = shape_.element_size(point.element, camera_) / options_.line_width;
    return cover * std::min(1.0, size / kWellSeen);
  }

  const Shape& shape_;
  const Box3& kept_;
  const Camera& camera_;
  const PictureOptions& options_;
  std::int32_t width_;
  std::int32_t height_;
  std::vector<Sample> samples_;
};

// How free the surroundings of a sample are, estimated from the samples around it (screen-space ambient occlusion; the
// estimator is that of M. McGuire, B. Osman, M. Bukowski, P. Hennessy, The Alchemy Screen-Space Ambient Obscurance
// Algorithm, HPG 2011). The samples of a pixel probe different places, so their mean is smooth without noise.
class Surroundings {
 public:
  Surroundings(const Camera& camera, std::int32_t samples)
      : camera_(camera), samples_(samples), radius_(kRadius * std::min(camera.width(), camera.height())) {
    // A sunflower (golden-angle) pattern over the disk; the samples of a pixel take its seeds in turn.
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    const std::int32_t places = samples * samples;
    places_.resize(static_cast<std::size_t>(places));
    for (std::int32_t seed = 0; seed < places * kLooks; ++seed) {
      const double r = radius_ * samples * std::sqrt((seed + 0.5) / (places * kLooks));
      const double angle = seed * golden_angle;
      places_[static_cast<std::size_t>(seed % places)].push_back(
          {static_cast<std::int32_t>(std::lround(r * std::cos(angle))),
           static_cast<std::int32_t>(std::lround(r * std::sin(angle)))});
    }
  }

  [[nodiscard]] double openness(const SamplePlane& plane, std::int32_t column, std::int32_t row) const {
    const Sample& sample = plane.at(column, row);
    const Vec3 normal = doubles(sample.normal);
    const Vec3 point = doubles(sample.point);
    const double reach = radius_ * camera_.pixel_size(point);
    const std::int32_t place = row % samples_ * samples_ + column % samples_;
    double hidden = 0;
    for (const auto& [x, y] : places_[static_cast<std::size_t>(place)]) {
      if (!plane.holds(column + x, row + y)) continue;
      const Sample& other = plane.at(column + x, row + y);
      if (!other.seen) continue;
      const Vec3 to = doubles(other.point) - point;
      const double squared = squared_norm(to) / (reach * reach);
      const double rise = dot(to, normal) / reach - kBias;
      if (rise <= 0) continue;
      // Things far in front of this point do not occlude its own surroundings.
      const double near = 1 / (1 + squared * squared);
      hidden += near * rise / (squared + 0.01);
    }
    return 1 / (1 + kStrength * hidden / kLooks);
  }

 private:
  static constexpr double kRadius = 0.06;  // of the picture's smaller side
  static constexpr double kBias = 0.03;    // small unevenness of the surface itself does not occlude it
  static constexpr double kStrength = 1.3;
  static constexpr std::int32_t kLooks = 10;  // per sample

  const Camera& camera_;
  std::int32_t samples_;
  double radius_;  // in pixels
  std::vector<std::vector<std::array<std::int32_t, 2>>> places_;
};

}  // namespace

bool draw(const Shape& shape, const Box3& kept, const Camera& camera, const PictureOptions& options, std::int32_t left,
          Image& image) {
  // What is seen.
  const SamplePlane plane(shape, kept, camera, options);
  const Surroundings surroundings(camera, options.samples);
  // How it looks: a pixel is the mean of its samples, where nothing is seen over the colour that it has (white).
  const std::int32_t n = options.samples;
  RowProgress progress(options, camera.height(), 0.5);
  run_tasks(static_cast<std::size_t>(camera.height()), options.threads, [&](std::size_t row_of_pixels) {
    const auto y = static_cast<std::int32_t>(row_of_pixels);
    for (std::int32_t x = 0; x < camera.width(); ++x) {
      Colour sum;
      std::int32_t seen = 0;
      for (std::int32_t i = 0; i < n * n; ++i) {
        const std::int32_t column = x * n + i % n;
        const std::int32_t row = y * n + i / n;
        const Sample& sample = plane.at(column, row);
        if (!sample.seen) continue;
        ++seen;
        sum += lit({{sample.normal[0], sample.normal[1], sample.normal[2]},
                    sample.outside,
                    surroundings.openness(plane, column, row),
                    sample.line});
      }
      if (seen == 0) continue;
      const double share = 1.0 / (n * n);
      const auto bytes = srgb(share * sum + (n * n - seen) * share * Colour{1, 1, 1});
      std::copy(bytes.begin(), bytes.end(), image.pixel(left + x, y));
    }
    progress.done();
  });
  return plane.shows_anything();
}

}  // namespace deliso
