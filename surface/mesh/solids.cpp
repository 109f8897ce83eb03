#include "surface/mesh/solids.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <utility>

#include "surface/mesh/axis_rays.h"

namespace deliso {

namespace {

// Coordinates that the exact predicates can compute with.
bool suits_predicates(const TriangleMesh& mesh) {
  return std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = std::abs(p[axis]);
      if (size != 0 && !(size >= 0x1p-160 && size <= 0x1p200)) return false;
    }
    return true;
  });
}

// Twice the area of a triangle's projection along x.
double projected_area(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
  return std::abs(p.y * q.z - p.z * q.y);
}

// How often components wind around a point: those with a number other than 0.
using Windings = std::map<std::uint32_t, int>;

class PartFinder {
 public:
  PartFinder(const TriangleMesh& mesh, const MeshTopology& topology)
      : mesh_(mesh), topology_(topology), rays_(mesh), triangles_of_(topology.components.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles_of_[component_of(t)].push_back(t);
  }

  // Sets the point of a part, whether it is solid, and finds the closed components around it.
  void find(const std::vector<bool>& is_closed, EnclosedPart& part, Windings& around) {
    for (const Vec3& p : candidates(part.component)) {
      std::optional<Windings> windings = windings_around(p, is_closed);
      if (!windings || !windings->contains(part.component)) continue;
      const auto is_simple = [](const auto& entry) { return std::abs(entry.second) == 1; };
      if (!std::all_of(windings->begin(), windings->end(), is_simple)) continue;
      part.point = p;
      part.is_solid = windings->at(part.component) > 0;
      around = std::move(*windings);
      return;
    }
  }

 private:
  [[nodiscard]] std::uint32_t component_of(std::uint32_t t) const {
    return topology_.component_of_vertex[mesh_.triangles[t][0]];
  }

  // Triangles that the lines to try pass: those with the largest projections, and others all over the component.
  [[nodiscard]] std::vector<std::uint32_t> triangles_to_try(std::uint32_t component) const {
    constexpr std::size_t kMost = 64, kFewest = 8, kShare = 8;  // of each kind; one in so many triangles
    std::vector<std::uint32_t> all = triangles_of_[component];
    const std::size_t count = std::min(all.size(), std::clamp(all.size() / kShare, kFewest, kMost));
    std::vector<std::uint32_t> tried;
    for (std::size_t i = 0; i < count; ++i) tried.push_back(all[i * all.size() / count]);
    const auto is_larger = [&](std::uint32_t s, std::uint32_t t) {
      return std::pair(-projected_area(mesh_, s), s) < std::pair(-projected_area(mesh_, t), t);
    };
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(), is_larger);
    tried.insert(tried.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    return tried;
  }

  // Points in the middle of stretches of lines that lie within the component and end at it: the longest first.
  std::vector<Vec3> candidates(std::uint32_t component) {
    constexpr std::size_t kMostPoints = 16;
    std::vector<std::pair<double, Vec3>> found;
    for (const std::uint32_t t : triangles_to_try(component)) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Vec3 p = (mesh_.points[a] + mesh_.points[b] + mesh_.points[c]) / 3;
      rays_.cross(p, crossings_);
      bool is_inside = false;
      for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
        const bool ends_here = component_of(crossings_[i].triangle) == component;
        is_inside = is_inside != ends_here;
        if (!is_inside || (!ends_here && component_of(crossings_[i + 1].triangle) != component)) continue;
        const double low = crossings_[i].x, high = crossings_[i + 1].x;
        if (high > low) found.push_back({high - low, {low + 0.5 * (high - low), p.y, p.z}});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& s, const auto& t) { return s.first > t.first; });
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < std::min(kMostPoints, found.size()); ++i) points.push_back(found[i].second);
    return points;
  }

  // None where the point lies on the mesh.
  std::optional<Windings> windings_around(const Vec3& p, const std::vector<bool>& is_closed) {
    if (rays_.may_touch(p)) return std::nullopt;
    Windings windings;
    rays_.cross(p, crossings_);
    for (const AxisCrossing& crossing : crossings_) {
      const std::uint32_t component = component_of(crossing.triangle);
      if (crossing.place > 0 && is_closed[component]) windings[component] += crossing.side;
    }
    std::erase_if(windings, [](const auto& entry) { return entry.second == 0; });
    return windings;
  }

  const TriangleMesh& mesh_;
  const MeshTopology& topology_;
  AxisRays rays_;
  std::vector<std::vector<std::uint32_t>> triangles_of_;  // of each component
  std::vector<AxisCrossing> crossings_;
};

std::vector<bool> closed_components(const MeshTopology& topology) {
  std::vector<bool> is_closed(topology.components.size());
  if (!topology.is_oriented()) return is_closed;
  for (std::size_t i = 0; i < is_closed.size(); ++i) is_closed[i] = topology.components[i].boundary_loops == 0;
  return is_closed;
}

// Parts whose points lie within each other's components: one of the points is not where it should be.
std::vector<bool> contradictions(const std::vector<EnclosedPart>& parts, const std::vector<Windings>& around,
                                 const std::vector<std::uint32_t>& part_of) {
  std::vector<bool> found(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const auto& [component, winding] : around[i]) {
      const std::uint32_t other = part_of[component];
      if (other != i && around[other].contains(parts[i].component)) found[i] = true;
    }
  }
  return found;
}

}  // namespace

EnclosedParts enclosed_parts(const TriangleMesh& mesh, const MeshTopology& topology) {
  EnclosedParts result;
  const std::vector<bool> is_closed = closed_components(topology);
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::uint32_t> part_of(is_closed.size(), kNone);
  for (std::uint32_t c = 0; c < is_closed.size(); ++c) {
    if (!is_closed[c]) {
      ++result.open_components;
      continue;
    }
    part_of[c] = static_cast<std::uint32_t>(result.parts.size());
    result.parts.push_back({c, true, std::nullopt, std::nullopt});
  }
  if (result.parts.empty() || !suits_predicates(mesh)) return result;

  PartFinder finder(mesh, topology);
  std::vector<Windings> around(result.parts.size());  // each part's point
  for (std::size_t i = 0; i < result.parts.size(); ++i) finder.find(is_closed, result.parts[i], around[i]);

  // The point of a part must not lie within a component inside: such a component and the part's own would each be
  // around the other's point. Of the parts around a component, the one that most others are around is its parent.
  const std::vector<bool> is_contradicted = contradictions(result.parts, around, part_of);
  for (std::size_t i = 0; i < result.parts.size(); ++i) {
    EnclosedPart& part = result.parts[i];
    if (is_contradicted[i]) part.point.reset();
    for (const auto& [component, winding] : around[i]) {
      const std::uint32_t other = part_of[component];
      if (other == i || is_contradicted[i]) continue;
      if (!part.parent || around[*part.parent].size() < around[other].size()) part.parent = other;
    }
  }
  return result;
}

}  // namespace deliso
