#include "volume/fields/analytic_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "delaunay/base/rng.h"

namespace deliso {

namespace {

constexpr double kPi = std::numbers::pi;

using Topology = std::optional<std::vector<KnownComponents>>;

double bell(double distance, double width) { return std::exp(-(distance / width) * (distance / width)); }

double ring_distance(const Vec3& p, double radius) { return std::hypot(std::hypot(p.x, p.y) - radius, p.z); }

// Distance to an ellipsoid with the given semi-axes, to first order.
double ellipsoid_distance(const Vec3& p, const Vec3& axes) {
  const Vec3 q{p.x / axes.x, p.y / axes.y, p.z / axes.z};
  const double slope = norm(Vec3{q.x / axes.x, q.y / axes.y, q.z / axes.z});
  return slope > 0 ? (norm(q) - 1) * norm(q) / slope : -std::min({axes.x, axes.y, axes.z});
}

// The smaller of a and b, rounded off where they differ by less than `width`.
double smooth_min(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

// ---- Smooth fields with known answers ----

FieldValues shells(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) {
    const double shell = bell(ellipsoid_distance(p, {0.82, 0.82, 0.72}), 0.1);
    return 230 * (shell + bell(ring_distance(p, 0.44), 0.13) + bell(norm(p), 0.19));
  };
}

FieldValues sphere(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return 1 - norm(p); };
}

FieldValues torus(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return 1 - ring_distance(p, 0.6); };
}

FieldValues double_torus(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) {
    // The figure eight y^2 = x^2 (1 - x^2), thickened; scaled like the Hounsfield units of a scan.
    const double x = p.x / 0.8;
    const double y = p.y / 0.8;
    const double z = p.z / 0.8;
    const double eight = x * x * (x * x - 1) + y * y;
    return 1000 - 10000 * (eight * eight + 0.25 * z * z);
  };
}

FieldValues linked_tori(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) {
    constexpr double kShift = 0.24;
    const double a = ring_distance({p.x + kShift, p.y, p.z}, 0.48);
    const double b = ring_distance({p.x - kShift, p.z, p.y}, 0.48);
    return 1 - std::min(a, b);
  };
}

FieldValues knot(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  // The trefoil knot as a closed polygon.
  constexpr std::size_t kPoints = 192;
  std::array<Vec3, kPoints + 1> curve;
  for (std::size_t n = 0; n <= kPoints; ++n) {
    const double t = 2 * kPi * static_cast<double>(n % kPoints) / kPoints;
    curve[n] = Vec3{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)} / 3.8;
  }
  return [curve](const Vec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < kPoints; ++n) {
      const Vec3 along = curve[n + 1] - curve[n];
      const double t = std::clamp(dot(p - curve[n], along) / squared_norm(along), 0.0, 1.0);
      nearest = std::min(nearest, squared_distance(p, curve[n] + t * along));
    }
    return 1 - std::sqrt(nearest);
  };
}

double gyroid_value(const Vec3& p, double periods) {
  const Vec3 q = kPi * periods * p;
  return std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) + std::sin(q.z) * std::cos(q.x);
}

FieldValues gyroid(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return gyroid_value(p, 2); };
}

FieldValues gyroid_scan(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return 127.5 + 80 * gyroid_value(p, 2); };
}

FieldValues gyroid_ball(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return smooth_min(gyroid_value(p, 2), 8 * (0.88 - norm(p)), 1.0); };
}

FieldValues marschner_lobb(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  // Marschner and Lobb, An evaluation of reconstruction filters for volume rendering, Visualization 1994.
  return [](const Vec3& p) {
    constexpr double kFrequency = 6;
    constexpr double kAlpha = 0.25;
    const double rings = std::cos(2 * kPi * kFrequency * std::cos(kPi * std::hypot(p.x, p.y) / 2));
    return 255 * (1 - std::sin(kPi * p.z / 2) + kAlpha * (1 + rings)) / (2 * (1 + kAlpha));
  };
}

FieldValues plane(std::int32_t /*size*/, std::uint64_t /*seed*/) {
  return [](const Vec3& p) { return dot(p, Vec3{0.2, 0.3, 0.9}); };
}

// ---- Hard cases ----

FieldValues sheets(std::int32_t size, std::uint64_t /*seed*/) {
  const double voxels = (size - 1) / 2.0;
  return [voxels](const Vec3& p) {
    const Vec3 normal = Vec3{0.15, 0.23, 1} / norm(Vec3{0.15, 0.23, 1});
    return voxels * std::abs(dot(normal, p) - 0.01);
  };
}

// A lattice of small balls, jittered: every ball keeps to its own box of at least 12 voxels.
std::int32_t balls_per_side(std::int32_t size) { return std::max(1, (size - 1) / 12); }

FieldValues bubbles(std::int32_t size, std::uint64_t seed) {
  struct Ball {
    Vec3 center;
    double radius = 0;
  };
  const std::int32_t side = balls_per_side(size);
  const double box = 2.0 / side;
  const auto lattice = static_cast<std::size_t>(side);
  Rng rng(seed);
  std::vector<Ball> balls;
  for (std::int32_t k = 0; k < side; ++k)
    for (std::int32_t j = 0; j < side; ++j)
      for (std::int32_t i = 0; i < side; ++i) {
        const auto place = [&](std::int32_t n) { return -1 + (n + rng.uniform(0.4, 0.6)) * box; };
        const double x = place(i);
        const double y = place(j);
        const double z = place(k);
        balls.push_back({{x, y, z}, rng.uniform(0.18, 0.28) * box});
      }
  // Samples are in voxels, so that the isovalue is a length in voxels too.
  const double voxels = (size - 1) / 2.0;
  return [=, balls = std::move(balls)](const Vec3& p) {
    double value = -std::numeric_limits<double>::infinity();
    const auto own = [&](double x) { return std::clamp(static_cast<std::int32_t>((x + 1) / box), 0, side - 1); };
    const auto first = [&](double x) { return std::max(own(x) - 1, 0); };
    const auto last = [&](double x) { return std::min(own(x) + 1, side - 1); };
    for (std::int32_t k = first(p.z); k <= last(p.z); ++k)
      for (std::int32_t j = first(p.y); j <= last(p.y); ++j)
        for (std::int32_t i = first(p.x); i <= last(p.x); ++i) {
          const Ball& ball = balls[(static_cast<std::size_t>(k) * lattice + static_cast<std::size_t>(j)) * lattice +
                                   static_cast<std::size_t>(i)];
          value = std::max(value, ball.radius - distance(p, ball.center));
        }
    return value * voxels;
  };
}

FieldValues blobs(std::int32_t /*size*/, std::uint64_t seed) {
  struct Blob {
    Vec3 center;
    double width = 0;
  };
  constexpr std::size_t kCount = 24;
  Rng rng(seed);
  std::vector<Blob> all(kCount);
  for (Blob& blob : all) {
    for (std::size_t axis = 0; axis < 3; ++axis) blob.center[axis] = rng.uniform(-0.6, 0.6);
    blob.width = rng.uniform(0.1, 0.17);
  }
  return [all = std::move(all)](const Vec3& p) {
    double sum = 0;
    for (const Blob& blob : all) sum += bell(distance(p, blob.center), blob.width);
    return sum;
  };
}

FieldValues noise(std::int32_t /*size*/, std::uint64_t seed) {
  return [rng = Rng(seed)](const Vec3&) mutable { return static_cast<double>(rng.next() >> 56); };
}

Topology one_sphere(std::int32_t) { return {{{2, 0, 1}}}; }
Topology one_torus(std::int32_t) { return {{{0, 0, 1}}}; }
Topology two_tori(std::int32_t) { return {{{0, 0, 2}}}; }
Topology genus_two(std::int32_t) { return {{{-2, 0, 1}}}; }
Topology torus_and_three_spheres(std::int32_t) { return {{{0, 0, 1}, {2, 0, 3}}}; }
Topology one_disk(std::int32_t) { return {{{1, 1, 1}}}; }
Topology two_disks(std::int32_t) { return {{{1, 1, 2}}}; }
Topology many_spheres(std::int32_t size) {
  const std::int64_t side = balls_per_side(size);
  return {{{2, 0, side * side * side}}};
}

// No sample can equal a suggested isovalue. Those of f32 fields are no f32 numbers, and those of integer fields no
// integers. The plane's samples are whole multiples of 0.1 / (size - 1), and its isovalue is none for any size up to
// the largest.
std::vector<AnalyticField> all_fields() {
  constexpr bool kClosed = true;
  constexpr bool kOpen = false;
  constexpr bool kSeeded = true;
  return {
      {"shells", "a ball in a ring in a hollow ellipsoid: a torus and three spheres, nested like a hydrogen atom", 64,
       100.5, "u8", kClosed, !kSeeded, 32, torus_and_three_spheres, shells},
      {"gyroid_ball", "two periods of the gyroid labyrinth inside a ball", 64, 0.1, "f32", kClosed, !kSeeded, 0,
       nullptr, gyroid_ball},
      {"knot", "a tube around the trefoil knot: one knotted torus", 80, 0.89, "f32", kClosed, !kSeeded, 40, one_torus,
       knot},
      {"sphere", "one minus the distance to the center: a sphere of radius 0.7", 48, 0.3, "f32", kClosed, !kSeeded, 8,
       one_sphere, sphere},
      {"torus", "one minus the distance to a circle of radius 0.6: a torus of tube radius 0.3", 48, 0.7, "f32", kClosed,
       !kSeeded, 12, one_torus, torus},
      {"double_torus", "a thickened figure eight: a surface of genus two", 64, 500.5, "i16", kClosed, !kSeeded, 32,
       genus_two, double_torus},
      {"linked_tori", "two linked rings", 64, 0.9, "f32", kClosed, !kSeeded, 32, two_tori, linked_tori},
      {"gyroid", "two periods of the gyroid, cut by the box", 64, 0.1, "f32", kOpen, !kSeeded, 0, nullptr, gyroid},
      {"gyroid_scan", "the gyroid in bytes, as a scanner would give it", 64, 135.5, "u8", kOpen, !kSeeded, 0, nullptr,
       gyroid_scan},
      {"marschner_lobb", "the test signal of Marschner and Lobb: rings close to the sampling limit", 41, 127.5, "u8",
       kOpen, !kSeeded, 0, nullptr, marschner_lobb},
      {"plane", "a linear ramp: one oblique plane, exact in the interpolant", 32, 0.123457, "f64", kOpen, !kSeeded, 4,
       one_disk, plane},
      {"sheets", "two parallel oblique planes; the isovalue is half their distance in voxels", 48, 1.3, "f32", kOpen,
       !kSeeded, 16, two_disks, sheets},
      {"bubbles", "a jittered lattice of small spheres, one in each box of 12 voxels", 48, 0.1, "f32", kClosed, kSeeded,
       13, many_spheres, bubbles},
      {"blobs", "a sum of 24 Gaussians at random places", 64, 0.6, "f32", kClosed, kSeeded, 0, nullptr, blobs},
      {"noise", "uniform random samples: the worst case", 16, 127.5, "u8", kOpen, kSeeded, 0, nullptr, noise},
  };
}

}  // namespace

const std::vector<AnalyticField>& analytic_fields() {
  static const std::vector<AnalyticField> kFields = all_fields();
  return kFields;
}

const AnalyticField& find_analytic_field(std::string_view name) {
  std::vector<std::string> known;
  for (const AnalyticField& field : analytic_fields()) {
    if (field.name == name) return field;
    known.push_back(field.name);
  }
  throw InputError("there is no built-in field \"" + std::string(name) + "\"" + nearest_name_hint(name, known));
}

}  // namespace deliso
