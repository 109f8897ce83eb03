// Removing vertices (after Devillers: On deletion in Delaunay triangulations, 2002; Devillers, Teillaud: Perturbations
// and vertex removal in a 3D Delaunay triangulation, 2003).
//
// Vertices connected by edges are removed together. The hole is the union of their stars; its link, here all remaining
// vertices of these tetrahedra, is hardly larger than that of one star. Every new tetrahedron in the hole has its
// vertices on the link and is in conflict with no remaining vertex. So it also belongs to the triangulation of the
// link's vertices alone, perturbed in the same order. We build that triangulation, and copy its tetrahedra inside the
// hole. Ghosts are handled alike. If every tetrahedron is destroyed, the hole has no rim, and the whole triangulation
// is copied.
//
// The same holds for any set of remaining vertices that contains the link. When the vertices of the link are coplanar,
// the far vertices of the tetrahedra around the star are added. If even these are all coplanar, only ghosts surround
// the star, and the remaining vertices are exactly those of the link.
#include <algorithm>
#include <numeric>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/bowyer_watson.h"

namespace deliso {

namespace {

constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;
constexpr std::size_t kMostAtOnce = 256;  // vertices removed together

using FacetName = std::array<VertexId, 3>;

// The vertices of a facet seen from one of its sides, the lowest first.
FacetName named(FacetName v) {
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

}  // namespace

bool BowyerWatson::remove(VertexId v, std::span<Going> others) {
  DELISO_CHECK(region_size_ == 0, "no cavity is open");
  DELISO_CHECK(v.index() < points_.size() && is_live(v), "only a live vertex can go");
  const Going before = v.index() < others.size() ? others[v.index()] : Going::kNo;
  hole_.others = others;
  hole_.gone.clear();
  take_along(v);
  find_star();
  const bool may_go = triangulate_link();
  if (may_go) {
    find_fill();
    glue_fill();
  }
  for (const VertexId gone : hole_.gone) {
    if (may_go) incident_[gone.index()] = TetId::none();
    if (gone.index() < others.size()) others[gone.index()] = may_go ? Going::kNo : Going::kYes;
  }
  if (!may_go && v.index() < others.size()) others[v.index()] = before;
  hole_.others = {};
  return may_go;
}

void BowyerWatson::take_along(VertexId v) {
  hole_.gone.push_back(v);
  if (v.index() < hole_.others.size()) hole_.others[v.index()] = Going::kNow;
}

bool BowyerWatson::goes_now(VertexId v) const {
  return v == hole_.gone.front() || (v.index() < hole_.others.size() && hole_.others[v.index()] == Going::kNow);
}

// Finds the vertices removed together, the tetrahedra at them, and the facets around these.
void BowyerWatson::find_star() {
  hole_.star.clear();
  hole_.vertices.clear();
  for (std::size_t i = 0; i < hole_.gone.size(); ++i) add_star(hole_.gone[i]);

  hole_.rim.clear();
  hole_.beyond.clear();
  for (const TetId t : hole_.star) {
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId mirror(tets_[t.index()].mirrors[face].value & kMirrorMask);
      if (mark(mirror.tet()) != kUnknown) continue;
      hole_.rim.push_back(FacetId(t, face));
      hole_.beyond.push_back(mirror);
    }
  }
  for (const TetId t : hole_.star) set_mark(t, kUnknown);
}

// Adds the tetrahedra at a removed vertex that are not in the star yet, and their vertices.
void BowyerWatson::add_star(VertexId v) {
  hole_.seen.resize(tet_slots(), 0);
  const std::uint32_t walk = ++hole_.walk;
  std::vector<TetId>& at_vertex = hole_.at_vertex;
  at_vertex.assign(1, incident_tet(v));
  hole_.seen[at_vertex.front().index()] = walk;
  for (std::size_t i = 0; i < at_vertex.size(); ++i) {
    const TetId t = at_vertex[i];
    for (unsigned face = 0; face < 4; ++face) {
      if (vertices(t)[face] == v) continue;
      const TetId across = FacetId(tets_[t.index()].mirrors[face].value & kMirrorMask).tet();
      if (std::exchange(hole_.seen[across.index()], walk) != walk) at_vertex.push_back(across);
    }
    if (mark(t) != kUnknown) continue;
    set_mark(t, kInside);
    hole_.star.push_back(t);
    for (const VertexId q : vertices(t)) {
      hole_.vertices.push_back(q);
      const bool may_go = q.index() < hole_.others.size() && hole_.others[q.index()] == Going::kYes;
      if (may_go && hole_.gone.size() < kMostAtOnce) take_along(q);
    }
  }
}

// Triangulates the vertices of the link in the order of the perturbation; false when all vertices left are coplanar.
bool BowyerWatson::triangulate_link() {
  if (!hole_.triangulation) hole_.triangulation = std::make_unique<BowyerWatson>(box_);
  for (const bool widened : {false, true}) {
    if (widened) {
      for (const FacetId f : hole_.beyond) hole_.vertices.push_back(vertices(f.tet())[f.face()]);
    }
    std::sort(hole_.vertices.begin(), hole_.vertices.end());
    hole_.vertices.erase(std::unique(hole_.vertices.begin(), hole_.vertices.end()), hole_.vertices.end());
    std::erase_if(hole_.vertices, [&](VertexId q) { return q == kInfiniteVertex || goes_now(q); });
    hole_.points.clear();
    for (const VertexId q : hole_.vertices) hole_.points.push_back(point(q));
    if (hole_.triangulation->build(hole_.points)) return true;
  }
  return false;
}

// Finds the tetrahedra of the link's triangulation that lie in the hole: those behind its rim, then their neighbours.
void BowyerWatson::find_fill() {
  const BowyerWatson& link = *hole_.triangulation;
  const auto name_there = [&](VertexId v) {
    if (v == kInfiniteVertex) return v;
    const auto at = std::lower_bound(hole_.vertices.begin(), hole_.vertices.end(), v);
    return VertexId(static_cast<std::size_t>(at - hole_.vertices.begin()));
  };
  // Step 1: the facets of the rim by their vertices, in the triangulation of the link.
  std::vector<std::pair<FacetName, std::uint32_t>>& rim = hole_.names;
  rim.clear();
  for (std::uint32_t i = 0; i < hole_.rim.size(); ++i) {
    const FacetName v = facet_vertices(hole_.rim[i]);
    rim.emplace_back(named({name_there(v[0]), name_there(v[1]), name_there(v[2])}), i);
  }
  std::sort(rim.begin(), rim.end());
  std::vector<std::uint32_t>& first = hole_.first;
  first.assign(hole_.vertices.size() + 1, 0);
  for (const auto& [name, i] : rim) ++first[name[0].index() + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());

  // Step 2: find these facets in that triangulation.
  hole_.rim_at.assign(4 * link.tet_slots(), kNowhere);
  hole_.place.assign(link.tet_slots(), kNowhere);
  hole_.fill.clear();
  const auto fill_with = [&](TetId t) {
    if (hole_.place[t.index()] != kNowhere) return;
    hole_.place[t.index()] = static_cast<std::uint32_t>(hole_.fill.size());
    hole_.fill.push_back(t);
  };
  std::size_t found = 0;
  for (std::size_t i = 0; i < hole_.rim_at.size(); ++i) {
    const FacetId f(static_cast<std::uint32_t>(i));
    if (!link.is_live(f.tet())) continue;
    const FacetName name = named(link.facet_vertices(f));
    const auto last = rim.begin() + first[name[0].index() + 1];
    const auto at = std::find_if(rim.begin() + first[name[0].index()], last,
                                 [&](const auto& entry) { return entry.first == name; });
    if (at == last) continue;
    hole_.rim_at[i] = at->second;
    fill_with(f.tet());
    ++found;
  }
  DELISO_CHECK(found == rim.size(), "the triangulation of the link holds the rim of the hole");

  // Step 3: cross every facet that is not on the rim; without a rim take all tetrahedra.
  for (std::size_t i = 0; rim.empty() && i < link.tet_slots(); ++i) {
    if (link.is_live(TetId(i))) fill_with(TetId(i));
  }
  for (std::size_t i = 0; i < hole_.fill.size(); ++i) {
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId f(hole_.fill[i], face);
      if (hole_.rim_at[f.index()] == kNowhere) fill_with(link.mirror(f).tet());
    }
  }
}

void BowyerWatson::glue_fill() {
  const BowyerWatson& link = *hole_.triangulation;
  take_slots(hole_.star, hole_.fill.size());
  for (std::size_t i = 0; i < hole_.fill.size(); ++i) {
    const TetId t = created_[i];
    Tet& tet = tets_[t.index()];
    for (unsigned slot = 0; slot < 4; ++slot) {
      const VertexId there = link.vertices(hole_.fill[i])[slot];
      tet.vertices[slot] = there == kInfiniteVertex ? there : hole_.vertices[there.index()];
      if (there != kInfiniteVertex) incident_[tet.vertices[slot].index()] = t;
      const FacetId f(hole_.fill[i], slot);
      if (const std::uint32_t at = hole_.rim_at[f.index()]; at != kNowhere) {
        const FacetId outside = hole_.beyond[at];
        tet.mirrors[slot] = outside;
        tets_[outside.tet().index()].mirrors[outside.face()] = FacetId(t, slot);
      } else {
        const FacetId mirror = link.mirror(f);
        tet.mirrors[slot] = FacetId(created_[hole_.place[mirror.tet().index()]], mirror.face());
      }
    }
  }
}

std::vector<VertexId> BowyerWatson::close_gaps() {
  hole_ = {};  // large where many vertices went together
  std::vector<VertexId> renamed(points_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_live(VertexId(i))) continue;
    renamed[i] = VertexId(count);
    points_[count] = points_[i];
    incident_[count] = incident_[i];
    ++count;
  }
  if (count == points_.size()) return renamed;
  points_.resize(count);
  incident_.resize(count);
  for (Tet& tet : tets_) {
    if (tet.vertices[0].is_none()) continue;
    for (VertexId& v : tet.vertices) {
      if (!v.is_none()) v = renamed[v.index()];
    }
  }
  return renamed;
}

}  // namespace deliso
