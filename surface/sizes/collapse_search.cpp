#include "surface/sizes/collapse_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/triangle_contact.h"
#include "surface/certificate/triangle_nearness.h"
#include "surface/mesh/triangle_area.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/shape/place_search.h"
#include "surface/sizes/triangle_samples.h"

namespace deliso {

namespace {

constexpr double kNoError = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostMeasured = 2;  // collapses of a vertex
constexpr std::size_t kLongestLink = 24;
constexpr double kSampleShare = 0.97;  // of the error allowed: what lies between the samples has the rest
// A vertex that is barely badly shaped triangles away from its end may go at the price of this share of the goal.
constexpr double kShapeWeight = 0.08;  // of a mean edge: what the worst shape costs against distance
constexpr double kTinySine = 1e-3;

bool has(const std::array<std::uint32_t, 3>& corners, std::uint32_t v) {
  return corners[0] == v || corners[1] == v || corners[2] == v;
}

}  // namespace

CollapseSearch::CollapseSearch(const Patch& mesh, const Witnesses& witnesses, const Isosurface& isosurface,
                               const DecimationOptions& options, SearchCounters& counters)
    : mesh_(mesh),
      witnesses_(witnesses),
      isosurface_(isosurface),
      options_(options),
      counters_(counters),
      goal_(std::sin(options.min_angle)) {}

std::optional<double> CollapseSearch::find(std::uint32_t vertex, bool is_last) {
  candidates_.clear();
  if (!learn_star(vertex)) return std::nullopt;
  const std::size_t count = link_.vertices.size();
  for (std::size_t apex = 0; apex < count; ++apex) {
    if (link_.is_closed || apex == 0 || apex + 1 == count) consider(apex);
  }
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  double least = kNoError, limit = options_.max_error;
  for (std::size_t i = 0, measured = 0; i < candidates_.size() && measured < kMostMeasured; ++i) {
    make_step(candidates_[i].apex);
    ++measured;
    double error = distance_of_isosurface(kSampleShare * limit) / kSampleShare;
    if (error <= limit) error = std::max(error, distance_of_mesh(limit));
    if (!(error <= limit) || (is_last && !(meets_nothing() && keeps_volume(tried_, vertex_) && stays_near()))) continue;
    least = limit = error;
    std::swap(best_, tried_);
    if (least <= candidates_[i].score) break;
  }
  return least < kNoError ? std::optional(least) : std::nullopt;
}

// False where the vertex must stay for its star alone.
bool CollapseSearch::learn_star(std::uint32_t vertex) {
  vertex_ = vertex;
  if (!mesh_.find_link(vertex, link_) || link_.triangles.size() < (link_.is_closed ? 3U : 2U)) return false;
  if (link_.triangles.size() > kLongestLink) return false;
  const Vec3& p = mesh_.point(vertex);
  normals_.clear();
  areas_.clear();
  least_sine_ = 1;
  mean_edge_ = longest_edge_ = 0;
  for (const std::uint32_t t : link_.triangles) {
    const auto [a, b, c] = mesh_.corner_points(t);
    const Vec3 normal = cross(b - a, c - a);
    const double area = norm(normal);
    normals_.push_back(area > 0 ? normal / area : Vec3{});
    areas_.push_back(area);
    least_sine_ = std::min(least_sine_, mesh_.quality(t));
  }
  for (const std::uint32_t u : link_.vertices) {
    const double length = distance(p, mesh_.point(u));
    mean_edge_ += length / static_cast<double>(link_.vertices.size());
    longest_edge_ = std::max(longest_edge_, length);
  }
  return true;
}

// Adds the collapse to a vertex of the link where shapes, sides and links allow it. Its score is the root mean square
// of that vertex's distances from the planes of the star (Garland and Heckbert, 1997, without memory), and grows with
// bad shape.
void CollapseSearch::consider(std::size_t apex) {
  const std::uint32_t kept = link_.vertices[apex];
  const Vec3 &p = mesh_.point(kept), &gone = mesh_.point(vertex_);
  const std::size_t count = link_.vertices.size();
  const double least_allowed = std::max(kTinySine, std::min(goal_, least_sine_));
  const double longest_allowed = std::max(options_.max_edge, longest_edge_);
  double least = 1;
  for (std::size_t i = 0; i < link_.triangles.size(); ++i) {
    const std::size_t j = (i + 1) % count;
    if (i == apex || j == apex) continue;
    const Vec3 &a = mesh_.point(link_.vertices[i]), &b = mesh_.point(link_.vertices[j]);
    const double sine = sine_of_least_angle(p, a, b);
    if (!(sine >= least_allowed) || !(dot(cross(a - p, b - p), normals_[i]) > 0)) return;
    if (std::isfinite(options_.max_edge) && (distance(p, a) > longest_allowed || distance(p, b) > longest_allowed)) {
      return;
    }
    least = std::min(least, sine);
  }
  if (!keeps_links(kept, apex) || !keeps_boundary(apex)) return;
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const double off = dot(normals_[i], p - gone);
    sum += areas_[i] * off * off;
    area += areas_[i];
  }
  candidates_.push_back({apex, std::sqrt(sum / area) + kShapeWeight * mean_edge_ * (1 - least)});
}

// The link condition: kept and removed vertex have no more neighbours in common than the triangles at their edge say.
bool CollapseSearch::keeps_links(std::uint32_t kept, std::size_t apex) const {
  const std::size_t count = link_.vertices.size();
  const auto at = [&](std::uint32_t v) {
    return static_cast<std::size_t>(std::find(link_.vertices.begin(), link_.vertices.end(), v) -
                                    link_.vertices.begin());
  };
  const auto is_beside = [&](std::size_t i) {
    if (link_.is_closed) return (i + 1) % count == apex || (apex + 1) % count == i;
    return i + 1 == apex || apex + 1 == i;
  };
  for (const std::uint32_t t : mesh_.star(kept)) {
    const auto& corners = mesh_.corners(t);
    if (has(corners, vertex_)) continue;
    std::size_t in_link = 0;
    for (const std::uint32_t v : corners) {
      const std::size_t i = v == kept ? count : at(v);
      if (i == count) continue;
      if (!is_beside(i)) return false;
      ++in_link;
    }
    if (in_link == 2) return false;  // a triangle on both its neighbours: of a tetrahedron, or of a strip's end
  }
  return true;
}

// A vertex of the boundary goes along it, within one face of the box.
bool CollapseSearch::keeps_boundary(std::size_t apex) const {
  if (link_.is_closed) return true;
  const Box3& box = isosurface_.box();
  const unsigned faces = faces_at(box, mesh_.point(vertex_));
  const std::size_t other = apex == 0 ? link_.vertices.size() - 1 : 0;
  return std::popcount(faces) == 1 && (faces & faces_at(box, mesh_.point(link_.vertices[apex]))) != 0 &&
         (faces & faces_at(box, mesh_.point(link_.vertices[other]))) != 0;
}

void CollapseSearch::make_step(std::size_t apex) {
  tried_ = {};
  tried_.kind = ShapeStep::kRemove;
  tried_.removed = link_.triangles;
  const std::size_t count = link_.vertices.size();
  for (std::size_t i = 0; i < link_.triangles.size(); ++i) {
    const std::size_t j = (i + 1) % count;
    if (i != apex && j != apex) {
      tried_.added.push_back({link_.vertices[apex], link_.vertices[i], link_.vertices[j]});
    }
  }
}

// The largest distance of a witness from its nearest new triangle, if that is at most the limit. Where more than that
// is found the others are not measured: then their distances are not known. (The square root of what exceeds the
// limit's square may be the limit.)
double CollapseSearch::distance_of_isosurface(double limit) const {
  double largest = 0;
  const auto measure = [&](const Vec3& p) {
    double least = kNoError;
    for (const auto& corners : tried_.added) {
      const auto [a, b, c] = points_of(corners);
      least = std::min(least, squared_distance_to_triangle(p, a, b, c));
    }
    largest = std::max(largest, least);
  };
  measure(mesh_.point(vertex_));
  for (const std::uint32_t t : tried_.removed) {
    witnesses_.for_each(t, [&](std::uint32_t w) {
      if (largest <= limit * limit) measure(witnesses_.point(w));
    });
    if (largest > limit * limit) return kNoError;
  }
  return std::sqrt(largest);
}

// The largest distance of a sample of the new triangles from the isosurface; at least that.
double CollapseSearch::distance_of_mesh(double limit) {
  double largest = 0;
  const double reach = kSampleShare * limit;
  for (const auto& corners : tried_.added) {
    const std::array<Vec3, 3> points = points_of(corners);
    const auto& [a, b, c] = points;
    const Vec3 normal = cross(b - a, c - a);
    const Vec3 unit = normal / norm(normal);
    samples_.clear();
    const double longest =
        std::sqrt(std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
    const auto take = [&](const Vec3& p) { samples_.push_back(p); };
    for_each_sample(points, longest, take);
    for (std::size_t first = 0; first < samples_.size(); first += kLanes) {
      const std::size_t count = std::min(kLanes, samples_.size() - first);
      LineLanes lines;
      std::array<bool, kLanes> asked{};
      Lanes hits;
      for (std::size_t i = 0; i < count; ++i) {
        lines.set(i, {samples_[first + i], unit});
        asked[i] = true;
      }
      isosurface_.nearest_falling_hits(lines, asked, reach, hits, counters_);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3& p = samples_[first + i];
        // No other sheet lies between: p is above the isovalue just where the isosurface lies ahead.
        const bool is_right = !std::isnan(hits[i]) && (hits[i] == 0 || (hits[i] > 0) == isosurface_.is_above(p));
        largest = std::max(largest, is_right ? std::abs(hits[i]) : distance_at(p, unit, reach));
        if (largest > reach) return kNoError;
      }
    }
  }
  return largest / kSampleShare;
}

// The same of one sample, down the gradient, if that is on the triangle's side.
double CollapseSearch::distance_at(const Vec3& p, const Vec3& normal, double limit) {
  constexpr double kFaces = 0.1;  // least cosine
  const Vec3 down = -isosurface_.gradient(p);
  const double steepness = norm(down);
  if (!(dot(down, normal) > kFaces * steepness)) return kNoError;
  const auto hit = isosurface_.nearest_falling_hit({p, down / steepness}, limit, counters_);
  return hit && (*hit > 0) == isosurface_.is_above(p) ? std::abs(*hit) : kNoError;
}

// What lies between the samples, too.
bool CollapseSearch::stays_near() const {
  return std::all_of(tried_.added.begin(), tried_.added.end(), [&](const auto& corners) {
    return count_far_parts(isosurface_, points_of(corners), options_.max_error, 1) == 0;
  });
}

// Exactly, of what is best.
bool CollapseSearch::meets_nothing() {
  const auto is_removed = [&](std::uint32_t t) {
    return std::find(tried_.removed.begin(), tried_.removed.end(), t) != tried_.removed.end();
  };
  for (std::size_t i = 0; i < tried_.added.size(); ++i) {
    const std::array<Vec3, 3> points = points_of(tried_.added[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const TriangleContact contact =
          triangle_contact(tried_.added[i], points, tried_.added[j], points_of(tried_.added[j]));
      if (contact != TriangleContact::kNone) return false;
    }
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    near_.clear();
    mesh_.append_near(box, near_);
    for (const std::uint32_t t : near_) {
      if (is_removed(t) || is_without_area(mesh_.corner_points(t))) continue;
      const TriangleContact contact =
          triangle_contact(tried_.added[i], points, mesh_.corners(t), mesh_.corner_points(t));
      if (contact != TriangleContact::kNone) return false;
    }
  }
  return true;
}

bool CollapseSearch::keeps_volume(const PatchStep& step, std::uint32_t vertex) {
  constexpr std::size_t kSmall = 40;  // triangles
  constexpr double kLeastShare = 0.5;
  if (component_.exceeds(mesh_, step.removed.front(), kSmall)) return true;
  const Vec3& apex = mesh_.point(vertex);
  const auto volume_of = [&](const std::array<Vec3, 3>& p) {
    return dot(p[0] - apex, cross(p[1] - apex, p[2] - apex)) / 6;
  };
  double volume = 0;
  near_.assign(1, step.removed.front());
  for (std::size_t i = 0; i < near_.size(); ++i) {
    volume += volume_of(mesh_.corner_points(near_[i]));
    const auto& corners = mesh_.corners(near_[i]);
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t beyond = mesh_.across(near_[i], corners[(side + 1) % 3], corners[(side + 2) % 3]);
      if (beyond == kNoVertex) return true;
      if (std::find(near_.begin(), near_.end(), beyond) == near_.end()) near_.push_back(beyond);
    }
  }
  double change = 0;  // triangles at the apex enclose nothing with it
  for (const auto& corners : step.added) change += volume_of(points_of(corners));
  return (volume + change) / volume >= kLeastShare;
}

}  // namespace deliso
