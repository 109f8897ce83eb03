#include "surface/extract/pinch_separation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include "delaunay/triangle_contact.h"
#include "surface/extract/pinch_directions.h"
#include "surface/extract/pinch_groups.h"
#include "surface/extract/pinch_neighbourhoods.h"

namespace deliso {

namespace {

// Distances tried, in mesh-space units; the last one only in stubborn sweeps. kEdgeFraction bounds the distance, as a
// fraction of the shortest edge at the copy.
constexpr std::array<double, 4> kDistances = {2e-4, 4e-5, 8e-6, 8e-4};
static_assert(kDistances.back() < kPinchSeparation);
constexpr double kEdgeFraction = 0.05;
constexpr int kCrossingWeight = 100;
// Sweeps over all groups. During the first one neighbouring copies may still share their position.
constexpr int kSweeps = 3;
// Further sweeps with more directions and a larger distance, if conflicts are left.
constexpr int kStubbornSweeps = 2;

class Separation {
 public:
  Separation(SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of,
             const Box3& box, const Box3& surface_box)
      : mesh_(mesh),
        groups_(groups),
        around_(mesh, groups, origin_of),
        box_(box),
        surface_box_(surface_box),
        triangles_(groups.size()),
        settled_at_(groups.size(), 0),
        moved_at_(groups.empty() ? 0 : mesh.points.size(), 0) {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      chosen_.push_back(i);
      for (const Copy& copy : groups_[i]) own_position_[copy.vertex] = mesh_.points[copy.vertex];
    }
  }

  // Leaves out groups that neither have a wanted copy nor influence one.
  void choose(const std::function<bool(std::uint32_t)>& is_wanted);

  void run() {
    Sweep last{true, true};
    for (int sweep = 0; sweep < kSweeps && last.has_moved; ++sweep) last = sweep_over_groups(sweep == 0, false);
    for (int sweep = 0; sweep < kStubbornSweeps && last.had_conflicts && (sweep == 0 || last.has_moved); ++sweep) {
      last = sweep_over_groups(false, true);
    }
  }

 private:
  // A triangle around the group, as of the last look_again_at().
  struct Surrounding {
    std::uint32_t triangle = 0;
    Box3 box;
    bool has_area = false;
  };

  struct Sweep {
    bool has_moved = false;
    bool had_conflicts = false;  // a copy had conflicts before it was moved
  };
  Sweep sweep_over_groups(bool all, bool is_stubborn);
  const std::vector<std::uint32_t>& triangles_around(std::size_t group);
  [[nodiscard]] bool is_settled(std::size_t group);
  void find_surroundings(std::size_t group);
  void look_again_at(std::uint32_t copy);
  void move(const Copy& copy, int fewest, bool is_stubborn);
  [[nodiscard]] int conflicts(std::uint32_t copy, int most = std::numeric_limits<int>::max());
  [[nodiscard]] int unavoidable_conflicts(std::uint32_t copy) const;
  [[nodiscard]] double shortest_edge(std::uint32_t copy, const Vec3& position) const;

  [[nodiscard]] bool has_area_at(std::uint32_t t) const {
    const auto& v = mesh_.triangles[t];
    return has_area(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }

  SurfaceMesh& mesh_;
  std::span<const PinchGroup> groups_;
  PinchNeighbourhoods around_;
  const Box3 &box_, &surface_box_;
  std::vector<Surrounding> surroundings_;                 // triangles around the group at hand
  std::unordered_map<std::uint32_t, Vec3> own_position_;  // the own position of each copy
  std::vector<std::size_t> chosen_;                       // groups to separate, ascending

  std::vector<std::vector<std::uint32_t>> triangles_;  // around each group, once they have been asked for
  std::uint32_t turn_ = 0;                             // counts the groups visited in all sweeps
  std::vector<std::uint32_t> settled_at_;              // of each group: the last turn that found no conflicts; or 0
  std::vector<std::uint32_t> moved_at_;                // of each vertex: the last turn that moved it; or 0
};

// Moves all copies, or those with conflicts.
Separation::Sweep Separation::sweep_over_groups(bool all, bool is_stubborn) {
  Sweep sweep;
  for (const std::size_t i : chosen_) {
    ++turn_;
    if (is_settled(i)) continue;
    find_surroundings(i);
    bool has_conflicts = false;
    for (const Copy& copy : groups_[i]) {
      const Vec3 before = mesh_.points[copy.vertex];
      const int now = all ? std::numeric_limits<int>::max() : conflicts(copy.vertex);
      if (now == 0) continue;
      move(copy, now, is_stubborn);
      has_conflicts = true;
      if (mesh_.points[copy.vertex] == before) continue;
      moved_at_[copy.vertex] = turn_;
      sweep.has_moved = true;
    }
    sweep.had_conflicts |= has_conflicts;
    settled_at_[i] = has_conflicts ? 0 : turn_;
  }
  return sweep;
}

// What happens to a group depends only on the vertices of the triangles around it. Further sweeps that only other
// groups need do not move its copies.
void Separation::choose(const std::function<bool(std::uint32_t)>& is_wanted) {
  const auto visit_vertices_around = [&](std::size_t group, const auto& visit) {
    for (const std::uint32_t t : triangles_around(group)) {
      for (const std::uint32_t v : mesh_.triangles[t]) visit(v);
    }
  };
  chosen_ = groups_that_matter(groups_, visit_vertices_around, is_wanted);
}

const std::vector<std::uint32_t>& Separation::triangles_around(std::size_t group) {
  if (triangles_[group].empty()) triangles_[group] = around_.triangles(group);
  return triangles_[group];
}

// Whether no copy had conflicts at the last visit and nothing around has moved since.
bool Separation::is_settled(std::size_t group) {
  if (settled_at_[group] == 0) return false;
  const std::vector<std::uint32_t>& triangles = triangles_around(group);
  return std::none_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    const auto& v = mesh_.triangles[t];
    return std::any_of(v.begin(), v.end(), [&](std::uint32_t q) { return moved_at_[q] > settled_at_[group]; });
  });
}

void Separation::find_surroundings(std::size_t group) {
  surroundings_.clear();
  for (const std::uint32_t t : triangles_around(group)) surroundings_.push_back({t, box_of(mesh_, t), has_area_at(t)});
}

// Updates the triangles at a copy, which may have moved.
void Separation::look_again_at(std::uint32_t copy) {
  for (Surrounding& t : surroundings_) {
    if (around_.is_at(t.triangle, copy)) t = {t.triangle, box_of(mesh_, t.triangle), has_area_at(t.triangle)};
  }
}

double Separation::shortest_edge(std::uint32_t copy, const Vec3& position) const {
  double shortest = box_.diagonal();
  for (const std::uint32_t t : around_.fan(copy)) {
    if (!around_.is_at(t, copy)) continue;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      const double length = distance(position, mesh_.points[v]);
      if (v != copy && length > 2 * kDistances.front()) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// Tries positions and takes the one with the fewest conflicts, the first of equals, if these are fewer than `fewest`.
void Separation::move(const Copy& copy, int fewest, bool is_stubborn) {
  const std::uint32_t v = copy.vertex;
  Vec3 best = mesh_.points[v];
  const int least = unavoidable_conflicts(v);
  std::vector<Vec3> positions = copy.other_positions;
  positions.insert(positions.begin(), own_position_[v]);
  for (const Vec3& position : positions) {
    const double farthest = kEdgeFraction * shortest_edge(v, position);
    mesh_.points[v] = position;
    for (const Vec3& towards : pinch_directions(mesh_, around_, box_, v, is_stubborn)) {
      for (const double length : std::span(kDistances).first(kDistances.size() - (is_stubborn ? 0 : 1))) {
        if (fewest <= least) break;
        mesh_.points[v] = surface_box_.clamp(position + std::min(length, farthest) * towards);
        const int left = conflicts(v, fewest);
        if (left >= fewest) continue;
        fewest = left;
        best = mesh_.points[v];
      }
    }
  }
  mesh_.points[v] = best;
  look_again_at(v);
}

// Counts the pairs of a triangle at this copy and a triangle around its group that meet beyond what they share. Copies
// of a neighbouring vertex may still share their position, so touching counts less than crossing. Stops counting at
// `most`.
int Separation::conflicts(std::uint32_t copy, int most) {
  look_again_at(copy);
  int count = 0;
  for (const std::uint32_t s : around_.fan(copy)) {
    if (count >= most) break;
    if (!around_.is_at(s, copy)) continue;
    if (!has_area_at(s)) {
      count += kCrossingWeight;
      continue;
    }
    const Box3 box = box_of(mesh_, s);
    for (const Surrounding& t : surroundings_) {
      if (s == t.triangle || !box.meets(t.box) || !t.has_area) continue;
      const bool is_at_copy = around_.is_at(t.triangle, copy);
      if (is_at_copy && t.triangle < s) continue;  // counted when t and s change roles
      const TriangleContact contact = triangle_contact(mesh_.points, mesh_.triangles[s], mesh_.triangles[t.triangle]);
      if (contact == TriangleContact::kNone) continue;
      count += (is_at_copy ? 2 : 1) * (contact == TriangleContact::kTouching ? 1 : kCrossingWeight);
    }
  }
  return count;
}

// A lower bound of conflicts(copy) for every position of the copy: other corners of its triangles may coincide with
// vertices around it.
int Separation::unavoidable_conflicts(std::uint32_t copy) const {
  int count = 0;
  for (const std::uint32_t s : around_.fan(copy)) {
    if (!around_.is_at(s, copy)) continue;
    const auto stands_at_corner = [&](std::uint32_t v) {
      return std::any_of(mesh_.triangles[s].begin(), mesh_.triangles[s].end(), [&](std::uint32_t corner) {
        return corner != copy && corner != v && mesh_.points[corner] == mesh_.points[v];
      });
    };
    int touching = 0;
    for (const Surrounding& t : surroundings_) {
      const auto& corners = mesh_.triangles[t.triangle];
      if (!t.has_area || around_.is_at(t.triangle, copy)) continue;
      if (std::any_of(corners.begin(), corners.end(), stands_at_corner)) ++touching;
    }
    count += std::min(touching, kCrossingWeight);
  }
  return count;
}

}  // namespace

void separate_pinches(SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of,
                      const Box3& box, const Box3& surface_box, const std::function<bool(std::uint32_t)>& is_wanted) {
  Separation separation(mesh, groups, origin_of, box, surface_box);
  if (is_wanted) separation.choose(is_wanted);
  separation.run();
}

}  // namespace deliso
