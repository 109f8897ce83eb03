#include "surface/shape/patch.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "surface/mesh/triangle_shape.h"

namespace deliso {

namespace {

constexpr std::size_t kUsualStar = 8;  // triangles; few vertices have more
constexpr std::size_t kLongest = 512;  // star whose link is searched
constexpr std::uint32_t kNoArc = 0xFFFFFFFFU;

// What a triangle of a star has of the link.
struct Arc {
  std::uint32_t from, to, next;
  bool is_entered;
};

// Finds the arc that follows each; false when two begin at the same vertex.
bool join_arcs(std::span<Arc> arcs) {
  using Start = std::pair<std::uint32_t, std::uint32_t>;  // vertex, arc
  std::array<Start, kLongest> room;                       // NOLINT(cppcoreguidelines-pro-type-member-init)
  const std::span starts(room.data(), arcs.size());
  for (std::uint32_t i = 0; i < arcs.size(); ++i) starts[i] = {arcs[i].from, i};
  std::sort(starts.begin(), starts.end());
  for (std::size_t i = 1; i < starts.size(); ++i) {
    if (starts[i].first == starts[i - 1].first) return false;
  }
  for (Arc& arc : arcs) {
    const auto next = std::lower_bound(starts.begin(), starts.end(), Start{arc.to, 0});
    if (next == starts.end() || next->first != arc.to) continue;
    arc.next = next->second;
    arcs[arc.next].is_entered = true;
  }
  return true;
}

}  // namespace

std::uint32_t Patch::add_vertex(const Vec3& point) {
  points_.push_back(point);
  is_whole_.push_back(Wholeness::kUnknown);
  stars_.emplace_back().reserve(kUsualStar);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t Patch::add_triangle(const std::array<std::uint32_t, 3>& corners) {
  const auto t = static_cast<std::uint32_t>(triangles_.size());
  triangles_.push_back(corners);
  const auto [a, b, c] = corner_points(t);
  qualities_.push_back(sine_of_least_angle(a, b, c));
  is_removed_.push_back(0);
  enter_stars(t);
  return t;
}

// A closed fan is all of the star, since the mesh is a manifold.
bool Patch::is_whole(std::uint32_t v) const {
  if (is_whole_[v] == Wholeness::kUnknown) {
    VertexLink link;
    std::vector<std::uint32_t> near;
    Box3 at;
    at.extend(points_[v]);
    const bool is_so = (find_link(v, link) && link.is_closed) || room_->holds(at, near);
    is_whole_[v] = is_so ? Wholeness::kWhole : Wholeness::kCut;
  }
  return is_whole_[v] == Wholeness::kWhole;
}

Box3 Patch::box_of(std::uint32_t t) const {
  Box3 box;
  for (const std::uint32_t v : triangles_[t]) box.extend(points_[v]);
  return box;
}

std::uint32_t Patch::across(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t u : stars_[a]) {
    if (u != t && std::find(triangles_[u].begin(), triangles_[u].end(), b) != triangles_[u].end()) return u;
  }
  return kNoVertex;
}

// Stars in flat cells have hundreds of triangles, so the arcs of the link are sorted by where they begin. All of it
// lies on the stack: decimation has several threads search one patch.
bool Patch::find_link(std::uint32_t v, VertexLink& link) const {
  const std::vector<std::uint32_t>& star = stars_[v];
  link.vertices.clear();
  link.triangles.clear();
  if (star.empty() || star.size() > kLongest) return false;
  std::array<Arc, kLongest> room;  // NOLINT(cppcoreguidelines-pro-type-member-init): only as many as are used
  const std::span arcs(room.data(), star.size());
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    const auto& corners = triangles_[star[i]];
    const std::size_t at = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
    arcs[i] = {corners[(at + 1) % 3], corners[(at + 2) % 3], kNoArc, false};
  }
  if (!join_arcs(arcs)) return false;

  const auto start = std::find_if(arcs.begin(), arcs.end(), [](const Arc& arc) { return !arc.is_entered; });
  link.is_closed = start == arcs.end();
  const auto first = link.is_closed ? 0U : static_cast<std::uint32_t>(start - arcs.begin());
  std::uint32_t at = first;
  do {
    link.vertices.push_back(arcs[at].from);
    link.triangles.push_back(star[at]);
    if (arcs[at].next == kNoArc) link.vertices.push_back(arcs[at].to);
    at = arcs[at].next;
  } while (at != kNoArc && at != first && link.triangles.size() < star.size());
  // Whether these are all, from end to end or once around.
  return link.triangles.size() == star.size() && at == (link.is_closed ? first : kNoArc) &&
         (!link.is_closed || star.size() >= 3);
}

std::vector<std::uint32_t> Patch::removed_since(std::size_t steps) const {
  std::vector<std::uint32_t> removed;
  for (std::size_t i = steps; i < journal_.size(); ++i) {
    removed.insert(removed.end(), journal_[i].removed.begin(), journal_[i].removed.end());
  }
  return removed;
}

void Patch::leave_stars(std::uint32_t t) {
  for (const std::uint32_t v : triangles_[t]) std::erase(stars_[v], t);
  places_.remove(t, box_of(t));
}

void Patch::enter_stars(std::uint32_t t) {
  for (const std::uint32_t v : triangles_[t]) stars_[v].push_back(t);
  places_.add(t, box_of(t));
}

void Patch::apply(const PatchStep& step) {
  Applied applied{step.removed, step.added.size(), step.vertex, false, {}};
  for (const std::uint32_t t : step.removed) {
    leave_stars(t);
    is_removed_[t] = 1;
  }
  if (step.vertex == points_.size()) {
    applied.is_new = true;
    is_whole_[add_vertex(step.point)] = Wholeness::kWhole;
  } else if (step.vertex != kNoVertex) {
    applied.old_point = std::exchange(points_[step.vertex], step.point);
  }
  for (const auto& corners : step.added) add_triangle(corners);
  journal_.push_back(std::move(applied));
}

void Patch::undo() {
  const Applied applied = std::move(journal_.back());
  journal_.pop_back();
  for (std::size_t i = 0; i < applied.added; ++i) {
    leave_stars(static_cast<std::uint32_t>(triangles_.size() - 1));
    triangles_.pop_back();
    qualities_.pop_back();
    is_removed_.pop_back();
  }
  if (applied.is_new) {
    points_.pop_back();
    is_whole_.pop_back();
    stars_.pop_back();
  } else if (applied.vertex != kNoVertex) {
    points_[applied.vertex] = applied.old_point;
  }
  for (const std::uint32_t t : applied.removed) {
    is_removed_[t] = 0;
    enter_stars(t);
  }
}

}  // namespace deliso
