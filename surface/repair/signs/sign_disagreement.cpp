#include "surface/repair/signs/sign_disagreement.h"

#include <algorithm>
#include <utility>

namespace deliso {

std::vector<DisagreementCluster> disagreement_clusters(const SignedDelaunay& restricted, const TetSigns& signs,
                                                       const std::function<std::int32_t(TetId)>& distance) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  struct Disputed {
    TetId tet;
    std::int32_t distance;  // kTaken when it is in a cluster
  };
  constexpr std::int32_t kTaken = -1;
  std::vector<Disputed> disputed;  // ascending
  restricted.for_each_difference(signs, [&](TetId t) {
    if (!delaunay.is_live(t)) return;
    const std::int32_t away = distance(t);
    if (away >= 0) disputed.push_back({t, away});
  });
  std::vector<DisagreementCluster> clusters;
  for (Disputed& seed : disputed) {
    if (seed.distance == kTaken) continue;
    DisagreementCluster cluster{{seed.tet}, std::exchange(seed.distance, kTaken)};
    for (std::size_t at = 0; at < cluster.tets.size(); ++at) {
      for (unsigned face = 0; face < 4; ++face) {
        const TetId next = delaunay.neighbour(cluster.tets[at], face);
        const auto found = std::lower_bound(disputed.begin(), disputed.end(), next,
                                            [](const Disputed& d, TetId t) { return d.tet < t; });
        if (found == disputed.end() || found->tet != next || found->distance == kTaken) continue;
        cluster.distance = std::min(cluster.distance, std::exchange(found->distance, kTaken));
        cluster.tets.push_back(next);
      }
    }
    clusters.push_back(std::move(cluster));
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const DisagreementCluster& a, const DisagreementCluster& b) { return a.distance < b.distance; });
  return clusters;
}

}  // namespace deliso
