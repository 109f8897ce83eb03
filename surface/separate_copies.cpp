#include "surface/separate_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "surface/self_intersection.h"

namespace deliso {

namespace {

// Distances tried, in mesh-space units, and the largest fraction of the shortest edge at the copy.
constexpr std::array<double, 3> kDistances = {2e-4, 4e-5, 8e-6};
constexpr double kEdgeFraction = 0.05;
// A direction is good when it makes at least this sine with every triangle of the fan.
constexpr double kLeastSine = 0.05;
constexpr int kSteps = 200;
constexpr int kCrossingWeight = 100;
// Sweeps over all groups: in the first one neighbouring copies may still share their place.
constexpr int kSweeps = 3;

class Separation {
 public:
  Separation(SurfaceMesh& mesh, std::span<const CopyGroup> groups, const Box3& box)
      : mesh_(mesh), groups_(groups), box_(box) {
    find_fans();
  }

  void run() {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const CopyGroup& group : groups_) {
        for (const std::uint32_t copy : group) {
          const int now = sweep == 0 ? std::numeric_limits<int>::max() : conflicts(group, copy);
          if (now > 0) move(group, copy, now);
        }
      }
    }
  }

 private:
  void find_fans();
  void move(const CopyGroup& group, std::uint32_t copy, int fewest);
  [[nodiscard]] std::optional<Vec3> direction(std::uint32_t copy, double side) const;
  [[nodiscard]] int conflicts(const CopyGroup& group, std::uint32_t copy) const;
  [[nodiscard]] double shortest_edge(std::uint32_t copy) const;
  [[nodiscard]] const std::vector<std::uint32_t>& fan(std::uint32_t copy) const { return fans_[place_[copy]]; }

  SurfaceMesh& mesh_;
  std::span<const CopyGroup> groups_;
  const Box3& box_;
  std::vector<std::uint32_t> place_;              // of each vertex: its fan, or kNoSide
  std::vector<std::vector<std::uint32_t>> fans_;  // triangles around each copy
  std::vector<Vec3> home_;                        // where each copy came from
};

void Separation::find_fans() {
  place_.assign(mesh_.points.size(), kNoSide);
  for (const CopyGroup& group : groups_) {
    for (const std::uint32_t copy : group) {
      place_[copy] = static_cast<std::uint32_t>(home_.size());
      home_.push_back(mesh_.points[copy]);
    }
  }
  fans_.resize(home_.size());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (place_[v] != kNoSide) fans_[place_[v]].push_back(t);
    }
  }
}

double Separation::shortest_edge(std::uint32_t copy) const {
  double shortest = box_.diagonal();
  for (const std::uint32_t t : fan(copy)) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      const double length = distance(home_[place_[copy]], mesh_.points[v]);
      if (v != copy && length > 2 * kDistances.front()) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// Takes the trial that leaves the fewest conflicts, the first of equals, if these are fewer than `fewest`.
void Separation::move(const CopyGroup& group, std::uint32_t copy, int fewest) {
  const Vec3 home = home_[place_[copy]];
  const double farthest = kEdgeFraction * shortest_edge(copy);
  Vec3 best = mesh_.points[copy];
  for (const double side : {1.0, -1.0}) {
    mesh_.points[copy] = home;
    const auto towards = direction(copy, side);
    for (const double length : kDistances) {
      if (!towards || fewest == 0) break;
      mesh_.points[copy] = home + std::min(length, farthest) * *towards;
      const int left = conflicts(group, copy);
      if (left >= fewest) continue;
      fewest = left;
      best = mesh_.points[copy];
    }
  }
  mesh_.points[copy] = best;
}

// A direction towards one side of all triangles at the copy, which is at home (perceptron steps towards the triangle
// that sees it least).
std::optional<Vec3> Separation::direction(std::uint32_t copy, double side) const {
  std::vector<Vec3> normals;
  Vec3 sum;
  for (const std::uint32_t t : fan(copy)) {
    const auto& v = mesh_.triangles[t];
    const Vec3 n = cross(mesh_.points[v[1]] - mesh_.points[v[0]], mesh_.points[v[2]] - mesh_.points[v[0]]);
    if (!(norm(n) > 0)) continue;
    normals.push_back(side / norm(n) * n);
    sum += normals.back();
  }
  const Vec3& at = mesh_.points[copy];
  const auto within_box_face = [&](Vec3 d) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == box_.low[axis] || at[axis] == box_.high[axis]) d[axis] = 0;
    }
    return d;
  };
  Vec3 d = within_box_face(sum);
  for (int step = 0; step < kSteps && norm(d) > 0; ++step) {
    d = d / norm(d);
    const auto least = std::min_element(normals.begin(), normals.end(),
                                        [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); });
    if (dot(*least, d) >= kLeastSine) return d;
    d += within_box_face((2 * kLeastSine - dot(*least, d)) * *least);
  }
  return std::nullopt;
}

// Counts pairs of triangles around this copy and around those of its group, itself included, that meet where they
// should not. Copies of a neighbouring vertex may still share their place, so touching counts less.
int Separation::conflicts(const CopyGroup& group, std::uint32_t copy) const {
  int count = 0;
  const auto has_area_at = [&](std::uint32_t t) {
    const auto& v = mesh_.triangles[t];
    return has_area(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  };
  for (const std::uint32_t s : fan(copy)) {
    if (!has_area_at(s)) {
      count += kCrossingWeight;
      continue;
    }
    for (const std::uint32_t other : group) {
      for (const std::uint32_t t : fan(other)) {
        if (s == t || !has_area_at(t)) continue;
        const TriangleContact contact = triangle_contact(mesh_.points, mesh_.triangles[s], mesh_.triangles[t]);
        if (contact == TriangleContact::kTouching) ++count;
        if (contact == TriangleContact::kCrossing) count += kCrossingWeight;
      }
    }
  }
  return count;
}

}  // namespace

void separate_copies(SurfaceMesh& mesh, std::span<const CopyGroup> groups, const Box3& box) {
  Separation(mesh, groups, box).run();
}

}  // namespace deliso
