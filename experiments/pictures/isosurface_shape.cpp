#include "experiments/pictures/isosurface_shape.h"

#include <algorithm>
#include <cmath>

namespace deliso {

// Walks from brick to brick along a ray.
class IsosurfaceShape::BrickWalk {
 public:
  // Starts in the brick that holds the ray's point at t.
  BrickWalk(const ScalarGrid& grid, const Brick& dims, const Line& ray, double t) : dims_(dims) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double size = grid.spacing()[a] * kBrickSide;
      const double place = (ray.at(t)[a] - grid.origin()[a]) / size;
      brick_[a] = static_cast<std::int32_t>(std::clamp(std::floor(place), 0.0, dims[a] - 1.0));
      ahead_[a] = ray.direction[a] > 0 ? 1 : -1;
      if (ray.direction[a] == 0) continue;
      // Brick plane n is crossed at first + n * step.
      first_[a] = (grid.origin()[a] - ray.origin[a]) / ray.direction[a];
      step_[a] = size / ray.direction[a];
      exit_[a] = crossing(a);
    }
  }

  [[nodiscard]] const Brick& brick() const { return brick_; }
  // Where the ray leaves the brick.
  [[nodiscard]] double exit() const { return std::min({exit_[0], exit_[1], exit_[2]}); }
  // To the next brick; false when that is outside the volume.
  bool step() {
    const std::size_t a = exit_[0] <= exit_[1] && exit_[0] <= exit_[2] ? 0 : exit_[1] <= exit_[2] ? 1 : 2;
    brick_[a] += ahead_[a];
    exit_[a] = crossing(a);
    return brick_[a] >= 0 && brick_[a] < dims_[a];
  }

 private:
  [[nodiscard]] double crossing(std::size_t a) const {
    return first_[a] + (brick_[a] + (ahead_[a] > 0 ? 1 : 0)) * step_[a];
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Brick dims_;
  Brick brick_{};
  Brick ahead_{};
  std::array<double, 3> first_{};
  std::array<double, 3> step_{};
  std::array<double, 3> exit_{kInfinity, kInfinity, kInfinity};
};

IsosurfaceShape::IsosurfaceShape(const ScalarGrid& grid, double isovalue)
    : grid_(grid),
      isovalue_(isovalue),
      surface_(grid, isovalue, SearchOptions()),
      box_(grid.box()),
      unit_(std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z})),
      brick_dims_{} {
  find_active_bricks();
}

void IsosurfaceShape::find_active_bricks() {
  const Dims& dims = grid_.dims();
  for (std::size_t a = 0; a < 3; ++a) brick_dims_[a] = (dims[a] - 2) / kBrickSide + 1;
  is_active_.assign(static_cast<std::size_t>(brick_dims_[0]) * static_cast<std::size_t>(brick_dims_[1]) *
                        static_cast<std::size_t>(brick_dims_[2]),
                    0);
  visit_samples(grid_.samples(), [&](const auto& samples) {
    // Neighbouring bricks share the samples on their common face.
    const auto is_active = [&](const Brick& brick) {
      bool above = false;
      bool below = false;
      Brick last;
      for (std::size_t a = 0; a < 3; ++a) last[a] = std::min((brick[a] + 1) * kBrickSide, dims[a] - 1);
      for (std::int32_t k = brick[2] * kBrickSide; k <= last[2]; ++k) {
        for (std::int32_t j = brick[1] * kBrickSide; j <= last[1]; ++j) {
          for (std::int32_t i = brick[0] * kBrickSide; i <= last[0]; ++i) {
            const bool is_above = static_cast<double>(samples[grid_.index(i, j, k)]) >= isovalue_;
            (is_above ? above : below) = true;
          }
        }
      }
      return above && below;
    };
    for (Brick b{}; b[2] < brick_dims_[2]; ++b[2]) {
      for (b[1] = 0; b[1] < brick_dims_[1]; ++b[1]) {
        for (b[0] = 0; b[0] < brick_dims_[0]; ++b[0]) is_active_[brick_index(b)] = is_active(b) ? 1 : 0;
      }
    }
  });
}

std::optional<SurfacePoint> IsosurfaceShape::first_hit(const Line& ray, double t0, double t1) const {
  const std::optional<RayPart> part = part_in_box(ray, box_);
  if (!part) return std::nullopt;
  const double first = std::max(t0, part->first);
  const double last = std::min(t1, part->last);
  if (!(first < last)) return std::nullopt;
  // The same ray in mesh space, with the same parameter.
  const Line line{(ray.origin - box_.low) / unit_, ray.direction / unit_};
  // Solved brick by brick, so that nothing behind the first hit is solved. Consecutive parts of the ray share their
  // ends, and both ends of a skipped part lie on one side of the surface, so no hit is lost.
  std::vector<Hit> hits;
  SearchCounters counters;
  BrickWalk walk(grid_, brick_dims_, ray, first);
  for (double begin = first; begin < last;) {
    const double end = std::min(std::max(begin, walk.exit()), last);
    if (is_active_[brick_index(walk.brick())] != 0) surface_.all_hits(line, begin, end, hits, counters);
    if (!hits.empty() || !walk.step()) break;
    begin = end;
  }
  if (hits.empty()) return std::nullopt;
  const Hit& hit = hits.front();
  // Rising: the ray comes from the side of lower values. The gradient points to higher ones.
  const Vec3 gradient = surface_.gradient(line.at(hit.t));
  const Vec3 towards_ray = hit.falling ? gradient : -gradient;
  const double length = norm(towards_ray);
  return SurfacePoint{hit.t, length > 0 ? towards_ray / length : -ray.direction, !hit.falling, 0};
}

std::vector<Vec3> IsosurfaceShape::outermost_points() const {
  std::vector<Vec3> points;
  const Dims& dims = grid_.dims();
  visit_samples(grid_.samples(), [&](const auto& samples) {
    std::array<std::int32_t, 3> s{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t stride = axis == 0 ? 1 : axis == 1 ? grid_.index(0, 1, 0) : grid_.index(0, 0, 1);
      // The crossing on the edge from sample s along the axis, if there is one.
      const auto crossing = [&]() -> std::optional<Vec3> {
        const std::size_t at = grid_.index(s[0], s[1], s[2]);
        const double from = static_cast<double>(samples[at]) - isovalue_;
        const double to = static_cast<double>(samples[at + stride]) - isovalue_;
        if ((from >= 0) == (to >= 0)) return std::nullopt;
        Vec3 index{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])};
        index[axis] += from / (from - to);
        return grid_.origin() + scaled(grid_.spacing(), index);
      };
      Dims edges = dims;
      --edges[axis];
      for (s[2] = 0; s[2] < edges[2]; ++s[2]) {
        for (s[1] = 0; s[1] < edges[1]; ++s[1]) {
          std::optional<Vec3> first;
          for (s[0] = 0; s[0] < edges[0] && !first; ++s[0]) first = crossing();
          if (!first) continue;
          points.push_back(*first);
          std::optional<Vec3> last;
          for (s[0] = edges[0] - 1; !last; --s[0]) last = crossing();
          points.push_back(*last);
        }
      }
    }
  });
  return points;
}

}  // namespace deliso
