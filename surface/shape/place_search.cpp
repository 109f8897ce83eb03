#include "surface/shape/place_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "surface/mesh/triangle_shape.h"

namespace deliso {

double star_quality(const Vec3& p, std::span<const RimSegment> rim, double floor) {
  const double squared_floor = floor * floor;
  double least = 1;
  for (const RimSegment& edge : rim) {
    const double squared = squared_sine_of_least_angle(p, edge.from, edge.to);
    if (!(squared > squared_floor)) return 0;
    least = std::min(least, squared);
  }
  return std::sqrt(least);
}

std::optional<Vec3> PlaceSearch::on_isosurface(const Vec3& p, const Vec3& normal, double reach) {
  const Line line{p, normal};
  const auto hit = isosurface_.nearest_falling_hit(line, reach, counters_);
  if (!hit || !isosurface_.box().contains(line.at(*hit))) return std::nullopt;
  return isosurface_.settled(line.at(*hit));
}

unsigned faces_at(const Box3& box, const Vec3& p) {
  unsigned faces = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (p[axis] == box.low[axis]) faces |= 1u << (2 * axis);
    if (p[axis] == box.high[axis]) faces |= 2u << (2 * axis);
  }
  return faces;
}

Vec3 outward_normal(unsigned faces) {
  const auto lowest = static_cast<unsigned>(std::countr_zero(faces));
  Vec3 outward;
  outward[lowest / 2] = lowest % 2 == 0 ? -1 : 1;
  return outward;
}

std::optional<Vec3> PlaceSearch::on_curve(const BoundaryCurve& curve, double fraction) {
  const Vec3 along = curve.end - curve.begin;
  const Vec3 towards_lower = cross(curve.outward, along);
  const double length = norm(towards_lower);
  if (!(length > 0)) return std::nullopt;
  return on_isosurface(curve.begin + fraction * along, towards_lower / length, length);
}

Place PlaceSearch::best_on_curve(std::span<const RimSegment> rim, std::span<const Vec3> starts,
                                 const BoundaryCurve& curve, double enough) {
  constexpr double kLastStep = 0.004;
  Place best;
  for (const Vec3& p : starts) {
    const double quality = star_quality(p, rim, best.quality);
    if (quality > best.quality) best = {p, quality};
  }
  const Vec3 along = curve.end - curve.begin;
  double fraction = dot(best.point - curve.begin, along) / squared_norm(along);
  for (double step = 0.25; step > kLastStep && best.quality < enough; step /= 2) {
    for (const double next : {fraction - step, fraction + step}) {
      if (!(next > 0 && next < 1)) continue;
      const auto p = on_curve(curve, next);
      const double quality = p ? star_quality(*p, rim, best.quality) : 0;
      if (quality <= best.quality) continue;
      best = {*p, quality};
      fraction = next;
    }
  }
  return best;
}

Place PlaceSearch::best(std::span<const RimSegment> rim, std::span<const Vec3> starts, const Vec3& normal,
                        double enough) {
  constexpr double kFirstStep = 0.3, kLastStep = 0.03;  // mean distances from the rim
  constexpr double kLeastStepGain = 1.005;
  constexpr int kMostSteps = 40;
  Place best;
  for (const Vec3& p : starts) {
    const double quality = star_quality(p, rim, best.quality);
    if (quality > best.quality) best = {p, quality};
  }
  if (!(best.quality > 0)) return best;
  double radius = 0;
  for (const RimSegment& edge : rim) radius += distance(best.point, edge.from);
  radius /= static_cast<double>(rim.size());
  // Eight directions of the tangent plane.
  const Vec3 axis = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 u = cross(normal, axis);
  u = u / norm(u);
  const Vec3 v = cross(normal, u);
  const double diagonal = std::sqrt(0.5);
  const std::array<Vec3, 8> directions = {u,  diagonal * (u + v),  v,  diagonal * (v - u),
                                          -u, -diagonal * (u + v), -v, diagonal * (u - v)};
  std::size_t first = 0;  // the direction that was good last
  double step = kFirstStep * radius;
  for (int i = 0; i < kMostSteps && step > kLastStep * radius && best.quality < enough; ++i) {
    const double before = best.quality;
    const Vec3 from = best.point;
    for (std::size_t tried = 0; tried < directions.size(); ++tried) {
      const std::size_t k = (first + tried) % directions.size();
      const Vec3 off = from + step * directions[k];
      // What is no better before it is brought to the isosurface seldom is then.
      if (star_quality(off, rim, best.quality) == 0) continue;
      const auto p = on_isosurface(off, normal, radius);
      const double quality = p ? star_quality(*p, rim, kLeastStepGain * best.quality) : 0;
      if (quality == 0) continue;
      best = {*p, quality};
      if (is_thorough_) continue;
      first = k;
      break;
    }
    if (best.quality == before) step /= 2;
  }
  return best;
}

}  // namespace deliso
