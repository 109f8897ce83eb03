// Taking a vertex away (after Devillers: On deletion in Delaunay triangulations, 2002; Devillers, Teillaud:
// Perturbations and vertex removal in a 3D Delaunay triangulation, 2003).
//
// Every tetrahedron that comes into the hole has its vertices on the link of the vertex that goes, and it is not in
// conflict with any vertex left. So it belongs to the triangulation of the link's vertices alone, too, perturbed in the
// same order: triangulate them, and take over what that triangulation has inside the hole. Ghosts are like the others.
//
// The same holds of any set of vertices left that the link is a part of. When the link's own are coplanar, the far
// vertices of the tetrahedra around the star are added. If all are coplanar then, around the star are ghosts alone, and
// the star is everything but its link.
#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/bowyer_watson.h"

namespace deliso {

namespace {

constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;

using FacetName = std::array<VertexId, 3>;

// The vertices of a facet seen from one of its sides, the least first.
FacetName named(FacetName v) {
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

}  // namespace

bool BowyerWatson::remove(VertexId v) {
  DELISO_CHECK(region_size_ == 0, "no cavity is open");
  DELISO_CHECK(v.index() < points_.size() && is_live(v), "only a live vertex can go");
  find_star(v);
  if (!triangulate_link()) return false;
  find_fill();
  glue_fill();
  incident_[v.index()] = TetId::none();
  return true;
}

// The tetrahedra at v, the facets around them, and the vertices of these.
void BowyerWatson::find_star(VertexId v) {
  hole_.star.assign(1, incident_tet(v));
  hole_.rim.clear();
  hole_.beyond.clear();
  hole_.vertices.clear();
  set_mark(hole_.star.front(), kInside);
  for (std::size_t i = 0; i < hole_.star.size(); ++i) {
    const TetId t = hole_.star[i];
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId mirror(tets_[t.index()].mirrors[face].value & kMirrorMask);
      if (vertices(t)[face] == v) {
        hole_.rim.push_back(FacetId(t, face));
        hole_.beyond.push_back(mirror);
      } else if (mark(mirror.tet()) == kUnknown) {
        set_mark(mirror.tet(), kInside);
        hole_.star.push_back(mirror.tet());
      }
    }
  }
  for (const TetId t : hole_.star) set_mark(t, kUnknown);
  for (const FacetId f : hole_.rim) {
    for (const VertexId q : facet_vertices(f)) hole_.vertices.push_back(q);
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
    if (hole_.vertices.back() == kInfiniteVertex) hole_.vertices.pop_back();
    hole_.points.clear();
    for (const VertexId q : hole_.vertices) hole_.points.push_back(point(q));
    if (hole_.triangulation->build(hole_.points)) return true;
  }
  return false;
}

// The tetrahedra of the link's triangulation that lie in the hole: those behind its rim, and on from there.
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

  // Step 2: find them there.
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
    const auto at = std::lower_bound(rim.begin(), rim.end(), name,
                                     [](const auto& entry, const FacetName& wanted) { return entry.first < wanted; });
    if (at == rim.end() || at->first != name) continue;
    hole_.rim_at[i] = at->second;
    fill_with(f.tet());
    ++found;
  }
  DELISO_CHECK(found == rim.size(), "the triangulation of the link holds the rim of the hole");

  // Step 3: what lies behind facets that are not on the rim.
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
