#include "surface/separate_copies.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <unordered_map>

#include "delaunay/triangle_contact.h"
#include "surface/copy_groups.h"
#include "surface/group_surroundings.h"

namespace deliso {

namespace {

// Distances tried, in mesh-space units, the last one in stubborn sweeps only; and the largest fraction of the shortest
// edge at the copy.
constexpr std::array<double, 4> kDistances = {2e-4, 4e-5, 8e-6, 8e-4};
static_assert(kDistances.back() < kHairsBreadth);
constexpr double kEdgeFraction = 0.05;
// A direction is good when it makes at least this sine with every triangle of the fan.
constexpr double kLeastSine = 0.05;
constexpr int kSteps = 200;
constexpr int kCrossingWeight = 100;
// Sweeps over all groups: in the first one neighbouring copies may still share their place.
constexpr int kSweeps = 3;
// Further sweeps with more directions and a larger distance, where conflicts are left.
constexpr int kStubbornSweeps = 2;

class Separation {
 public:
  Separation(SurfaceMesh& mesh, std::span<const CopyGroup> groups, std::span<const VertexId> origin_of, const Box3& box)
      : mesh_(mesh), groups_(groups), around_(mesh, groups, origin_of), box_(box) {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      chosen_.push_back(i);
      for (const Copy& copy : groups_[i]) home_[copy.vertex] = mesh_.points[copy.vertex];
    }
  }

  // Leaves groups out that have no wanted copy and make no difference to one that has.
  void choose(const std::function<bool(std::uint32_t)>& is_wanted);

  void run() {
    Sweep last{true, true};
    for (int sweep = 0; sweep < kSweeps && last.has_moved; ++sweep) last = sweep_over_groups(sweep == 0, false);
    for (int sweep = 0; sweep < kStubbornSweeps && last.had_conflicts && (sweep == 0 || last.has_moved); ++sweep) {
      last = sweep_over_groups(false, true);
    }
  }

 private:
  // A triangle as it was when last looked at.
  struct Surrounding {
    std::uint32_t triangle = 0;
    Box3 box;
    bool has_area = false;
  };

  struct Sweep {
    bool has_moved = false;
    bool had_conflicts = false;  // some copy had, when its turn came
  };
  Sweep sweep_over_groups(bool all, bool is_stubborn);
  void find_surroundings(std::size_t group);
  void look_again_at(std::uint32_t copy);
  void move(const Copy& copy, int fewest, bool is_stubborn);
  [[nodiscard]] std::vector<Vec3> directions(std::uint32_t copy, bool is_stubborn) const;
  [[nodiscard]] Vec3 within_box_face(const Vec3& at, Vec3 d) const;
  [[nodiscard]] std::optional<Vec3> direction(std::uint32_t copy, double side) const;
  [[nodiscard]] int conflicts(std::uint32_t copy, int most = std::numeric_limits<int>::max());
  [[nodiscard]] int unavoidable_conflicts(std::uint32_t copy) const;
  [[nodiscard]] double shortest_edge(std::uint32_t copy, const Vec3& home) const;

  [[nodiscard]] bool has_area_at(std::uint32_t t) const {
    const auto& v = mesh_.triangles[t];
    return has_area(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }

  SurfaceMesh& mesh_;
  std::span<const CopyGroup> groups_;
  GroupSurroundings around_;
  const Box3& box_;
  std::vector<Surrounding> surroundings_;         // triangles around the group at hand
  std::unordered_map<std::uint32_t, Vec3> home_;  // where each copy came from
  std::vector<std::size_t> chosen_;               // groups to separate, ascending
};

// Moves all copies, or those with conflicts.
Separation::Sweep Separation::sweep_over_groups(bool all, bool is_stubborn) {
  Sweep sweep;
  for (const std::size_t i : chosen_) {
    find_surroundings(i);
    for (const Copy& copy : groups_[i]) {
      const Vec3 before = mesh_.points[copy.vertex];
      const int now = all ? std::numeric_limits<int>::max() : conflicts(copy.vertex);
      if (now == 0) continue;
      move(copy, now, is_stubborn);
      sweep.had_conflicts = true;
      sweep.has_moved |= mesh_.points[copy.vertex] != before;
    }
  }
  return sweep;
}

// What is done with a group depends on the vertices of the triangles around it alone, and sweeps that only others need
// move none of its copies.
void Separation::choose(const std::function<bool(std::uint32_t)>& is_wanted) {
  const auto visit_vertices_around = [&](std::size_t group, const auto& visit) {
    for (const std::uint32_t t : around_.triangles(group)) {
      for (const std::uint32_t v : mesh_.triangles[t]) visit(v);
    }
  };
  chosen_ = groups_that_matter(groups_, visit_vertices_around, is_wanted);
}

void Separation::find_surroundings(std::size_t group) {
  surroundings_.clear();
  for (const std::uint32_t t : around_.triangles(group)) surroundings_.push_back({t, box_of(mesh_, t), has_area_at(t)});
}

// A copy may have moved, and the triangles at it with it.
void Separation::look_again_at(std::uint32_t copy) {
  for (Surrounding& t : surroundings_) {
    if (around_.is_at(t.triangle, copy)) t = {t.triangle, box_of(mesh_, t.triangle), has_area_at(t.triangle)};
  }
}

double Separation::shortest_edge(std::uint32_t copy, const Vec3& home) const {
  double shortest = box_.diagonal();
  for (const std::uint32_t t : around_.fan(copy)) {
    if (!around_.is_at(t, copy)) continue;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      const double length = distance(home, mesh_.points[v]);
      if (v != copy && length > 2 * kDistances.front()) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// Takes the trial that leaves the fewest conflicts, the first of equals, if these are fewer than `fewest`.
void Separation::move(const Copy& copy, int fewest, bool is_stubborn) {
  const std::uint32_t v = copy.vertex;
  Vec3 best = mesh_.points[v];
  const int least = unavoidable_conflicts(v);
  std::vector<Vec3> homes = copy.other_homes;
  homes.insert(homes.begin(), home_[v]);
  for (const Vec3& home : homes) {
    const double farthest = kEdgeFraction * shortest_edge(v, home);
    mesh_.points[v] = home;
    for (const Vec3& towards : directions(v, is_stubborn)) {
      for (const double length : std::span(kDistances).first(kDistances.size() - (is_stubborn ? 0 : 1))) {
        if (fewest <= least) break;
        mesh_.points[v] = home + std::min(length, farthest) * towards;
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

// Directions to try, the most promising first: towards either side of the whole fan; then, for a fan that no direction
// sees as a whole or where these did not help, a few all around.
std::vector<Vec3> Separation::directions(std::uint32_t copy, bool is_stubborn) const {
  std::vector<Vec3> directions;
  for (const double side : {1.0, -1.0}) {
    if (const auto d = direction(copy, side)) directions.push_back(*d);
  }
  if (directions.size() == 2 && !is_stubborn) return directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 d = within_box_face(mesh_.points[copy], Vec3{z * 1.0, y * 1.0, x * 1.0});
        if (norm(d) > 0) directions.push_back(d / norm(d));
      }
    }
  }
  return directions;
}

Vec3 Separation::within_box_face(const Vec3& at, Vec3 d) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (at[axis] == box_.low[axis] || at[axis] == box_.high[axis]) d[axis] = 0;
  }
  return d;
}

// A direction towards one side of all triangles at the copy, which is at home (perceptron steps towards the triangle
// that sees it least).
std::optional<Vec3> Separation::direction(std::uint32_t copy, double side) const {
  std::vector<Vec3> normals;
  Vec3 sum;
  for (const std::uint32_t t : around_.fan(copy)) {
    if (!around_.is_at(t, copy)) continue;
    const auto& v = mesh_.triangles[t];
    const Vec3 n = cross(mesh_.points[v[1]] - mesh_.points[v[0]], mesh_.points[v[2]] - mesh_.points[v[0]]);
    if (!(norm(n) > 0)) continue;
    normals.push_back(side / norm(n) * n);
    sum += normals.back();
  }
  const Vec3& at = mesh_.points[copy];
  Vec3 d = within_box_face(at, sum);
  for (int step = 0; step < kSteps && norm(d) > 0; ++step) {
    d = d / norm(d);
    const auto least = std::min_element(normals.begin(), normals.end(),
                                        [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); });
    if (dot(*least, d) >= kLeastSine) return d;
    d += within_box_face(at, (2 * kLeastSine - dot(*least, d)) * *least);
  }
  return std::nullopt;
}

// Counts pairs of a triangle at this copy and one around its group that meet where they should not. Copies of a
// neighbouring vertex may still share their place, so touching counts less. Counts no further than `most`.
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
      const TriangleContact contact = triangle_contact(mesh_.points, mesh_.triangles[s], mesh_.triangles[t.triangle]);
      if (contact == TriangleContact::kTouching) ++count;
      if (contact == TriangleContact::kCrossing) count += kCrossingWeight;
    }
  }
  return count;
}

// A bound of conflicts(copy) wherever the copy is: other corners of its triangles may stand where vertices around do.
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

void separate_copies(SurfaceMesh& mesh, std::span<const CopyGroup> groups, std::span<const VertexId> origin_of,
                     const Box3& box, const std::function<bool(std::uint32_t)>& is_wanted) {
  Separation separation(mesh, groups, origin_of, box);
  if (is_wanted) separation.choose(is_wanted);
  separation.run();
}

}  // namespace deliso
