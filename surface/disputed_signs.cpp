#include "surface/disputed_signs.h"

#include <algorithm>
#include <utility>

namespace deliso {

std::vector<DisputedCluster> disputed_clusters(const SignedDelaunay& restricted, const TetSigns& signs,
                                               const std::function<std::int32_t(TetId)>& distance) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  constexpr std::int32_t kNotDisputed = -1;
  std::vector<std::int32_t> distance_of(delaunay.tet_slots(), kNotDisputed);
  for (std::size_t i = 0; i < distance_of.size(); ++i) {
    const TetId t(i);
    if (delaunay.is_live(t) && restricted.is_above(t) != (signs[i] != 0)) distance_of[i] = distance(t);
  }
  std::vector<DisputedCluster> clusters;
  for (std::size_t seed = 0; seed < distance_of.size(); ++seed) {
    if (distance_of[seed] < 0) continue;
    DisputedCluster cluster{{TetId(seed)}, std::exchange(distance_of[seed], kNotDisputed)};
    for (std::size_t at = 0; at < cluster.tets.size(); ++at) {
      for (unsigned face = 0; face < 4; ++face) {
        const TetId next = delaunay.neighbour(cluster.tets[at], face);
        if (distance_of[next.index()] < 0) continue;
        cluster.distance = std::min(cluster.distance, std::exchange(distance_of[next.index()], kNotDisputed));
        cluster.tets.push_back(next);
      }
    }
    clusters.push_back(std::move(cluster));
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const DisputedCluster& a, const DisputedCluster& b) { return a.distance < b.distance; });
  return clusters;
}

}  // namespace deliso
