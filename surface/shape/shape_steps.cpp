#include "surface/shape/shape_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "surface/mesh/triangle_shape.h"
#include "surface/shape/best_filling.h"

namespace deliso {

namespace {

bool holds(const std::vector<std::uint32_t>& list, std::uint32_t x) {
  return std::find(list.begin(), list.end(), x) != list.end();
}

}  // namespace

void ShapeSteps::propose(ShapeStep kind, std::uint32_t triangle, std::size_t corner, double enough,
                         std::vector<PatchStep>& steps) {
  switch (kind) {
    case ShapeStep::kFlip:
      return flip(side_of(triangle, corner), enough, steps);
    case ShapeStep::kRemove:
      return remove(patch_.corners(triangle)[corner], steps);
    case ShapeStep::kMove:
      return move(patch_.corners(triangle)[corner], enough, steps);
    case ShapeStep::kMerge:
      return merge(side_of(triangle, corner), enough, steps);
    case ShapeStep::kSplit:
      return split(side_of(triangle, corner), enough, steps);
    case ShapeStep::kInsert:
      if (corner == 0) insert(triangle, enough, steps);
      return;
    case ShapeStep::kCount:
      return;
  }
}

ShapeSteps::Side ShapeSteps::side_of(std::uint32_t triangle, std::size_t corner) const {
  const auto& corners = patch_.corners(triangle);
  Side side{triangle, corners[(corner + 1) % 3], corners[(corner + 2) % 3], corners[corner]};
  side.beyond = patch_.across(triangle, side.a, side.b);
  if (side.beyond == kNoVertex) return side;
  const auto& beyond = patch_.corners(side.beyond);
  side.d = *std::find_if(beyond.begin(), beyond.end(), [&](std::uint32_t v) { return v != side.a && v != side.b; });
  return side;
}

bool ShapeSteps::are_whole(const std::vector<std::uint32_t>& triangles) const {
  return std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    const auto& corners = patch_.corners(t);
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return patch_.is_whole(v); });
  });
}

Vec3 ShapeSteps::normal_of(const std::vector<std::uint32_t>& triangles) const {
  Vec3 sum;
  for (const std::uint32_t t : triangles) {
    const auto [a, b, c] = patch_.corner_points(t);
    sum += cross(b - a, c - a);
  }
  const double length = norm(sum);
  return length > 0 ? sum / length : Vec3{};
}

void ShapeSteps::flip(const Side& side, double enough, std::vector<PatchStep>& steps) {
  const auto [triangle, a, b, c, beyond, d] = side;
  if (beyond == kNoVertex) {
    drop(side, steps);
    drop_two(side, steps);
    open(side, enough, steps);
    return;
  }
  PatchStep step{ShapeStep::kFlip, {triangle, beyond}, {{c, a, d}, {c, d, b}}, kNoVertex, {}, 1, {}};
  if (!are_whole(step.removed)) return;
  for (const auto& t : step.added) {
    step.quality =
        std::min(step.quality, sine_of_least_angle(patch_.point(t[0]), patch_.point(t[1]), patch_.point(t[2])));
  }
  steps.push_back(std::move(step));
}

void ShapeSteps::remove(std::uint32_t v, std::vector<PatchStep>& steps) {
  constexpr std::size_t kLongestLink = 12;
  if (!patch_.is_whole(v) || !patch_.find_link(v, link_)) return;
  if (!link_.is_closed && link_.triangles.size() == 1) {
    remove_ear(v, steps);
    return;
  }
  if (!link_.is_closed || link_.vertices.size() < 3 || link_.vertices.size() > kLongestLink) return;
  PatchStep step{ShapeStep::kRemove, link_.triangles, {}, kNoVertex, {}, 0, {}};
  if (!are_whole(step.removed)) return;
  std::vector<Vec3> polygon;
  for (const std::uint32_t u : link_.vertices) polygon.push_back(patch_.point(u));
  // Around a neck of three edges two vertices of the link are neighbours already, by an edge that is not in the star. A
  // second edge between them would not be refused before the guard, and with it all fillings.
  const auto is_free = [&](std::size_t i, std::size_t j) {
    return patch_.across(kNoVertex, link_.vertices[i], link_.vertices[j]) == kNoVertex;
  };
  const BestFilling filling(polygon, is_free);
  step.quality = filling.quality();
  for (const auto& [i, j, k] : filling.triangles()) {
    step.added.push_back({link_.vertices[i], link_.vertices[j], link_.vertices[k]});
  }
  steps.push_back(std::move(step));
}

bool ShapeSteps::halve(PatchStep& step) {
  if (step.vertex == kNoVertex || step.is_on_boundary || step.point == step.start) return false;
  const Vec3 normal = normal_of(step.removed);
  const auto p = search_.on_isosurface(0.5 * (step.start + step.point), normal, distance(step.start, step.point));
  if (!p) return false;
  rim_.clear();
  for (const auto& t : step.added) rim_.push_back({patch_.point(t[1]), patch_.point(t[2])});
  step.point = *p;
  step.quality = star_quality(*p, rim_);
  return true;
}

void ShapeSteps::place(PatchStep step, const std::vector<Vec3>& starts, double enough, std::vector<PatchStep>& steps) {
  if (!are_whole(step.removed)) return;
  rim_.clear();
  for (const auto& t : step.added) rim_.push_back({patch_.point(t[1]), patch_.point(t[2])});
  const Vec3 normal = normal_of(step.removed);
  if (rim_.empty() || squared_norm(normal) == 0) return;
  finish(std::move(step), search_.best(rim_, starts, normal, enough), starts, steps);
}

void ShapeSteps::place_on_curve(PatchStep step, const std::vector<Vec3>& starts, const BoundaryCurve& curve,
                                double enough, std::vector<PatchStep>& steps) {
  if (!are_whole(step.removed)) return;
  rim_.clear();
  for (const auto& t : step.added) rim_.push_back({patch_.point(t[1]), patch_.point(t[2])});
  if (rim_.empty()) return;
  step.is_on_boundary = true;
  finish(std::move(step), search_.best_on_curve(rim_, starts, curve, enough), starts, steps);
}

void ShapeSteps::finish(PatchStep step, const Place& best, const std::vector<Vec3>& starts,
                        std::vector<PatchStep>& steps) {
  if (!(best.quality > 0)) return;
  step.start = starts.front();
  step.point = best.point;
  step.quality = best.quality;
  steps.push_back(std::move(step));
}

// A vertex with the star that it has, which is in link_ then.
std::optional<PatchStep> ShapeSteps::star_of(std::uint32_t v) {
  if (!patch_.is_whole(v) || !patch_.find_link(v, link_)) return std::nullopt;
  PatchStep step{ShapeStep::kMove, link_.triangles, {}, v, {}, 0, {}};
  const std::vector<std::uint32_t>& link = link_.vertices;
  for (std::size_t i = 0; i < link_.triangles.size(); ++i) {
    step.added.push_back({v, link[i], link[(i + 1) % link.size()]});
  }
  return step;
}

void ShapeSteps::move(std::uint32_t v, double enough, std::vector<PatchStep>& steps) {
  auto step = star_of(v);
  if (!step) return;
  if (link_.is_closed) {
    place(std::move(*step), {patch_.point(v)}, enough, steps);
  } else if (const auto along = curve(link_.vertices.back(), link_.vertices.front(), {v})) {
    place_on_curve(std::move(*step), {patch_.point(v)}, *along, enough, steps);
  }
}

void ShapeSteps::displace(std::uint32_t v, std::uint32_t neighbour, double share, std::vector<PatchStep>& steps) {
  auto step = star_of(v);
  if (!step || !link_.is_closed || !are_whole(step->removed)) return;
  const Vec3 &from = patch_.point(v), &to = patch_.point(neighbour);
  const auto p = search_.on_isosurface(from + share * (to - from), normal_of(step->removed), distance(from, to));
  if (p) finish(std::move(*step), {*p, 1}, {from}, steps);
}

// Of the corners of an edge one goes, and the other takes the star over the rim of both stars.
void ShapeSteps::merge(const Side& side, double enough, std::vector<PatchStep>& steps) {
  const std::uint32_t a = side.a, b = side.b;
  if (!patch_.is_whole(a) || !patch_.is_whole(b)) return;
  if (!patch_.find_link(a, link_) || !patch_.find_link(b, other_link_)) return;
  const bool is_boundary_edge = side.beyond == kNoVertex;
  if (is_boundary_edge) {
    merge(a, b, true, enough, steps);
    std::swap(link_, other_link_);
    merge(b, a, true, enough, steps);
  } else if (other_link_.is_closed) {
    merge(a, b, false, enough, steps);
  } else if (link_.is_closed) {
    std::swap(link_, other_link_);
    merge(b, a, false, enough, steps);
  }
}

// Precondition: link_ is that of the vertex that is kept, other_link_ that of the one that goes.
void ShapeSteps::merge(std::uint32_t kept, std::uint32_t gone, bool is_boundary_edge, double enough,
                       std::vector<PatchStep>& steps) {
  PatchStep step{ShapeStep::kMerge, link_.triangles, {}, kept, {}, 0, {}};
  for (const std::uint32_t t : other_link_.triangles) {
    if (!holds(step.removed, t)) step.removed.push_back(t);
  }
  for (const std::uint32_t t : step.removed) {
    const auto& c = patch_.corners(t);
    const bool has_kept = std::find(c.begin(), c.end(), kept) != c.end();
    const bool has_gone = std::find(c.begin(), c.end(), gone) != c.end();
    if (has_kept && has_gone) continue;
    const std::uint32_t center = has_kept ? kept : gone;
    const std::size_t at = c[0] == center ? 0 : c[1] == center ? 1 : 2;
    step.added.push_back({kept, c[(at + 1) % 3], c[(at + 2) % 3]});
  }
  const Vec3 &p = patch_.point(kept), &q = patch_.point(gone);
  if (!link_.is_closed) {
    // The vertex in a face of the box stays where it is, unless both lie on the curve.
    std::optional<BoundaryCurve> along;
    if (is_boundary_edge) {
      if (std::popcount(faces_at(search_.isosurface().box(), q)) != 1) return;
      const bool is_after = link_.vertices.front() == gone;
      along = is_after ? curve(link_.vertices.back(), other_link_.vertices.front(), {kept, gone})
                       : curve(other_link_.vertices.back(), link_.vertices.front(), {kept, gone});
    }
    if (along) {
      place_on_curve(std::move(step), {p, q}, *along, enough, steps);
    } else {
      step.is_on_boundary = true;
      place(std::move(step), {p}, 0, steps);
    }
    return;
  }
  std::vector<Vec3> starts = {p, q};
  const Vec3 normal = normal_of(step.removed);
  if (const auto middle = search_.on_isosurface(0.5 * (p + q), normal, distance(p, q))) starts.push_back(*middle);
  place(std::move(step), starts, enough, steps);
}

// Where the isosurface passes the middle of an inner side: along the normal of both triangles, or, as at the rims of
// thin walls, along a line from between the apexes or from one of them.
std::optional<Vec3> ShapeSteps::middle_of(const Side& side) {
  const Vec3 &a = patch_.point(side.a), &b = patch_.point(side.b), &c = patch_.point(side.c), &d = patch_.point(side.d);
  const Vec3 middle = 0.5 * (a + b);
  const double reach = distance(a, b);
  auto hit = search_.on_isosurface(middle, normal_of({side.triangle, side.beyond}), reach);
  for (const Vec3& from : {0.5 * (c + d), c, d}) {
    if (hit) break;
    const double length = distance(from, middle);
    if (length > 0) hit = search_.on_isosurface(middle, (middle - from) / length, std::min(reach, length));
  }
  return hit;
}

void ShapeSteps::split(const Side& side, double enough, std::vector<PatchStep>& steps) {
  const auto [triangle, a, b, c, beyond, d] = side;
  const auto p = static_cast<std::uint32_t>(patch_.vertex_count());
  if (beyond == kNoVertex) {
    PatchStep step{ShapeStep::kSplit, {triangle}, {{p, b, c}, {p, c, a}}, p, {}, 0, {}};
    const auto along = curve(a, b, {});
    const auto middle = along ? search_.on_curve(*along, 0.5) : std::nullopt;
    if (middle) place_on_curve(std::move(step), {*middle}, *along, enough, steps);
    return;
  }
  PatchStep step{ShapeStep::kSplit, {triangle, beyond}, {{p, b, c}, {p, c, a}, {p, a, d}, {p, d, b}}, p, {}, 0, {}};
  if (const auto middle = middle_of(side)) place(std::move(step), {*middle}, enough, steps);
}

void ShapeSteps::bisect(std::uint32_t triangle, std::size_t corner, std::vector<PatchStep>& steps) {
  const Side side = side_of(triangle, corner);
  if (side.beyond == kNoVertex) return split(side, 0, steps);
  const auto [t, a, b, c, beyond, d] = side;
  const auto p = static_cast<std::uint32_t>(patch_.vertex_count());
  PatchStep step{ShapeStep::kSplit, {t, beyond}, {{p, b, c}, {p, c, a}, {p, a, d}, {p, d, b}}, p, {}, 0, {}};
  const auto point = middle_of(side);
  if (!point || !are_whole(step.removed)) return;
  step.point = step.start = *point;
  steps.push_back(std::move(step));
}

// A vertex over the rim of a triangle and its neighbours.
void ShapeSteps::insert(std::uint32_t triangle, double enough, std::vector<PatchStep>& steps) {
  const auto p = static_cast<std::uint32_t>(patch_.vertex_count());
  PatchStep step{ShapeStep::kInsert, {triangle}, {}, p, {}, 0, {}};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Side side = side_of(triangle, corner);
    if (side.beyond == kNoVertex) {
      step.added.push_back({p, side.a, side.b});
      continue;
    }
    step.removed.push_back(side.beyond);
    step.added.push_back({p, side.a, side.d});
    step.added.push_back({p, side.d, side.b});
  }
  const auto [a, b, c] = patch_.corner_points(triangle);
  const double reach = distance(a, b) + distance(b, c);
  const auto start = search_.on_isosurface((a + b + c) / 3, normal_of(step.removed), reach);
  if (start) place(std::move(step), {*start}, enough, steps);
}

}  // namespace deliso
