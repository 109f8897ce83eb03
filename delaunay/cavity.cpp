// The second half of an insertion: the star of the point replaces the conflict region.
#include <algorithm>
#include <atomic>

#include "delaunay/base/check.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/circumcenter_pairs.h"
#include "delaunay/constructions.h"

namespace deliso {

namespace {

// The vertex slots of face i in such an order that they form a negative tetrahedron with the slot opposite put first.
// Slot 3, which holds the infinite vertex of a ghost, comes last.
constexpr unsigned kStarSlots[4][3] = {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}};

}  // namespace

VertexId BowyerWatson::fill_cavity() {
  DELISO_CHECK(region_size_ > 0, "find_conflicts has found a region");
  const VertexId v(points_.size());
  points_.push_back(pending_);
  incident_.emplace_back();
  star_rim(v);
  return v;
}

void BowyerWatson::abandon_cavity() {
  region_size_ = 0;
  rim_size_ = 0;
}

// Provides slots for the tetrahedra to be created.
void BowyerWatson::take_slots(std::span<const TetId> old, std::size_t count) {
  // The slots of destroyed tetrahedra are used first, then free ones, then new ones; unused slots become free.
  const std::size_t reused = std::min(old.size(), count);
  created_.assign(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(reused));
  for (const TetId t : old.subspan(reused)) {
    tets_[t.index()].vertices[0] = VertexId::none();
    free_.push_back(t);
  }
  while (created_.size() < count) {
    if (free_.empty()) {
      if (tets_.size() >= kMostTets) {
        throw InputError("the triangulation needs more than " + std::to_string(kMostTets) +
                         " tetrahedra, expected no more");
      }
      created_.push_back(TetId(tets_.size()));
      tets_.emplace_back();
    } else {
      created_.push_back(free_.back());
      free_.pop_back();
    }
  }
}

void BowyerWatson::star_rim(VertexId apex) {
  take_slots(conflict_region(), rim_size_);
  if (rows_.size() <= SquareEdgeTable::kMostNumbers) {
    edges_.start(rows_.size());
    star_rim(apex, edges_);
  } else {
    HashedEdgeTable edges(3 * std::size_t{rim_size_});
    star_rim(apex, edges);
  }
  incident_[apex.index()] = created_.front();
  region_size_ = 0;
  rim_size_ = 0;
}

template <class EdgeTable>
void BowyerWatson::star_rim(VertexId apex, EdgeTable& edges) {
  // Step 1: one tetrahedron over each facet of the rim, glued to the facet. Each of its other three faces stands on a
  // directed edge of the rim.
  for (std::uint32_t i = 0; i < rim_size_; ++i) {
    const Corners& corners = region_corners_[rim_from_[i] >> 2];
    const auto& slots = kStarSlots[rim_from_[i] & 3u];
    const std::uint32_t x = corners[slots[0]];
    const std::uint32_t y = corners[slots[1]];
    const std::uint32_t z = corners[slots[2]];
    const TetId t = created_[i];
    const FacetId outside = rim_[i];
    Tet& tet = tets_[t.index()];
    tet.vertices = {apex, rows_.id(x), rows_.id(y), rows_.id(z)};
    tet.mirrors[0] = outside;
    // A part may write this mirror while another part reads its marks, see mark().
    std::atomic_ref(tets_[outside.tet().index()].mirrors[outside.face()].value)
        .store(FacetId(t, 0).value, std::memory_order_relaxed);
    edges.at(y, z) = FacetId(t, 1);
    edges.at(z, x) = FacetId(t, 2);
    edges.at(x, y) = FacetId(t, 3);
    incident_[rows_.id(x).index()] = t;
    incident_[rows_.id(y).index()] = t;
    if (z != LiftedRows::kInfinite) incident_[rows_.id(z).index()] = t;
  }
  // Step 2: the mirror of such a face is the one on the reversed edge.
  for (std::uint32_t i = 0; i < rim_size_; ++i) {
    const Corners& corners = region_corners_[rim_from_[i] >> 2];
    const auto& slots = kStarSlots[rim_from_[i] & 3u];
    const std::uint32_t x = corners[slots[0]];
    const std::uint32_t y = corners[slots[1]];
    const std::uint32_t z = corners[slots[2]];
    auto& mirrors = tets_[created_[i].index()].mirrors;
    mirrors[1] = edges.at(z, y);
    mirrors[2] = edges.at(x, z);
    mirrors[3] = edges.at(y, x);
  }
}

void BowyerWatson::circumcenters_of_star(std::span<Vec3> centers) const {
  const auto row = [&](std::size_t i, unsigned k) -> const LiftedRow& {
    const std::uint32_t from = rim_from_[i];
    return rows_.row(region_corners_[from >> 2][kStarSlots[from & 3u][k]]);
  };
  for (std::size_t i = 0; i < created_.size(); i += 2) {
    const std::array<std::size_t, 2> pair = {i, std::min(i + 1, created_.size() - 1)};
    const auto rows = [&](unsigned k) { return RowPair(row(pair[0], k), row(pair[1], k)); };
    const CircumcenterPair found = circumcenter_pair(pending_, rows(0), rows(1), rows(2));
    for (unsigned k = 0; k < 2; ++k) {
      if (found.is_certain[k]) [[likely]] {
        centers[pair[k]] = found.centers.at(k);
      } else if (const TetId t = created_[pair[k]]; !is_ghost(t)) {
        const auto& v = vertices(t);
        centers[pair[k]] = circumcenter(point(v[0]), point(v[1]), point(v[2]), point(v[3]));
      }
    }
  }
}

}  // namespace deliso
