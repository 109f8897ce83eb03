#include "surface/repair/diagnosis/small_components.h"

#include <algorithm>
#include <array>
#include <limits>

#include "delaunay/base/box3.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

namespace {

constexpr std::int64_t kMostCrossings = 32;
// A crossing may be so many of the box's diagonal away from the mesh, but no more than elsewhere (mesh-space units).
constexpr double kFarthestPart = 0.25;
constexpr double kFarthest = 0.8;

}  // namespace

SmallComponents::SmallComponents(const ExactSurface& surface)
    : speck_of_(surface.topology.components.size(), kNoSmallComponent) {
  const IsosurfaceTopology& topology = surface.topology;
  std::vector<std::int64_t> count(topology.components.size(), 0);
  for (const EdgeCrossing& crossing : topology.crossings) ++count[crossing.component];
  for (std::uint32_t c = 0; c < count.size(); ++c) {
    if (count[c] > kMostCrossings) continue;
    speck_of_[c] = static_cast<std::uint32_t>(specks_.size());
    specks_.push_back({c, 0, {}});
  }
  for (const EdgeCrossing& crossing : topology.crossings) {
    const std::uint32_t speck = speck_of_[crossing.component];
    if (speck != kNoSmallComponent) specks_[speck].crossings.push_back(surface.position(crossing));
  }
  for (Speck& speck : specks_) {
    Box3 box;
    for (const Vec3& p : speck.crossings) box.extend(p);
    speck.farthest = std::min(kFarthestPart * box.diagonal(), kFarthest);
  }
}

std::vector<std::uint32_t> SmallComponents::missed_by(const MatchedMesh& mesh) const {
  // The triangles of the specks' main pieces.
  using Corners = std::array<Vec3, 3>;
  std::vector<std::vector<Corners>> triangles(specks_.size());
  const ComponentMatch& match = mesh.match;
  for (const auto& [a, b, c] : mesh.built.mesh.triangles) {
    const std::uint32_t piece = match.piece_of[a];
    const std::uint32_t component = match.pieces[piece].component;
    if (speck_of_[component] == kNoSmallComponent || match.main_piece[component] != piece) continue;
    const std::vector<Vec3>& points = mesh.built.mesh.points;
    triangles[speck_of_[component]].push_back({points[a], points[b], points[c]});
  }
  const auto is_missed = [&](std::size_t i, const Vec3& p) {
    const double most = specks_[i].farthest * specks_[i].farthest;
    return std::none_of(triangles[i].begin(), triangles[i].end(),
                        [&](const Corners& t) { return squared_distance_to_triangle(p, t[0], t[1], t[2]) <= most; });
  };
  std::vector<std::uint32_t> missed;
  for (std::size_t i = 0; i < specks_.size(); ++i) {
    const std::vector<Vec3>& crossings = specks_[i].crossings;
    if (std::any_of(crossings.begin(), crossings.end(), [&](const Vec3& p) { return is_missed(i, p); })) {
      missed.push_back(specks_[i].component);
    }
  }
  return missed;
}

}  // namespace deliso
