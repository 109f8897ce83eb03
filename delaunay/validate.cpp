#include "delaunay/validate.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "delaunay/predicates.h"

namespace deliso {
namespace {

using Violation = std::optional<std::string>;

std::string name(TetId t) { return "tetrahedron " + std::to_string(t.value); }
std::string name(VertexId v) { return v == kInfiniteVertex ? "infinite vertex" : "vertex " + std::to_string(v.value); }
std::string name(FacetId f) { return "face " + std::to_string(f.face()) + " of " + name(f.tet()); }

bool has_vertex(const Tetrahedralization& tets, TetId t, VertexId v) {
  const auto& vertices = tets.vertices(t);
  return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
}

// The first violation that `check` finds on a live tetrahedron.
template <class Check>
Violation first_violation(const Tetrahedralization& tets, Check check) {
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
    if (!tets.is_live(TetId(i))) continue;
    if (Violation violation = check(TetId(i))) return violation;
  }
  return std::nullopt;
}

Violation check_vertices(const Tetrahedralization& tets, TetId t) {
  const auto& v = tets.vertices(t);
  for (unsigned i = 0; i < 4; ++i) {
    if (v[i] == kInfiniteVertex ? i != 3 : v[i].index() >= tets.vertex_count() || !tets.is_live(v[i])) {
      return name(t) + " has no valid vertex in slot " + std::to_string(i);
    }
    for (unsigned j = 0; j < i; ++j) {
      if (v[i] == v[j]) return name(t) + " has " + name(v[i]) + " twice";
    }
  }
  return std::nullopt;
}

Violation check_mirrors(const Tetrahedralization& tets, TetId t) {
  for (unsigned face = 0; face < 4; ++face) {
    const FacetId f(t, face);
    const FacetId mirror = tets.mirror(f);
    if (mirror.is_none() || mirror.tet().index() >= tets.tet_slots() || !tets.is_live(mirror.tet())) {
      return name(f) + " has no live neighbour";
    }
    if (tets.mirror(mirror) != f) return name(f) + " is not the mirror of its mirror";
    // Seen from the other side the same three vertices have the opposite orientation.
    const auto here = tets.facet_vertices(f);
    auto there = tets.facet_vertices(mirror);
    std::reverse(there.begin(), there.end());
    const auto first = std::find(there.begin(), there.end(), here[0]);
    std::rotate(there.begin(), first, there.end());
    if (here != there) return name(f) + " and its mirror have different vertices or the same orientation";
  }
  return std::nullopt;
}

// v - e + f - t of the closed complex, where f = 2 t.
Violation check_euler_relation(const Tetrahedralization& tets) {
  std::unordered_set<std::uint64_t> edges;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
    if (!tets.is_live(TetId(i))) continue;
    ++count;
    const auto& v = tets.vertices(TetId(i));
    for (unsigned a = 0; a < 4; ++a) {
      for (unsigned b = 0; b < a; ++b) {
        const auto [low, high] = std::minmax(v[a].value, v[b].value);
        edges.insert((static_cast<std::uint64_t>(high) << 32) | low);
      }
    }
  }
  if (count == 0) return std::nullopt;
  std::size_t vertices = 1;  // the infinite one
  for (std::size_t i = 0; i < tets.vertex_count(); ++i) vertices += tets.is_live(VertexId(i)) ? 1 : 0;
  if (vertices + count == edges.size()) return std::nullopt;
  return "the Euler relation fails: " + std::to_string(vertices) + " vertices, " + std::to_string(edges.size()) +
         " edges, " + std::to_string(count) + " tetrahedra";
}

// Whether vertex v is in conflict with tetrahedron t, ties perturbed; v is not a vertex of t.
bool in_conflict(const Tetrahedralization& tets, TetId t, VertexId v) {
  const Vec3& p = tets.point(v);
  if (tets.is_ghost(t)) {
    const auto& hull = tets.vertices(t);
    const double side = orient3d(tets.point(hull[0]), tets.point(hull[1]), tets.point(hull[2]), p);
    if (side != 0) return side > 0;
    t = tets.neighbour(t, 3);
    if (has_vertex(tets, t, v)) return false;  // only when that tetrahedron is flat, which another check reports
  }
  const auto& ids = tets.vertices(t);
  const std::array<Vec3, 4> tet = {tets.point(ids[0]), tets.point(ids[1]), tets.point(ids[2]), tets.point(ids[3])};
  const double inside = insphere(tet[0], tet[1], tet[2], tet[3], p);
  return inside != 0 ? inside > 0 : perturbed_insphere(tet, ids, p, v);
}

std::string conflict(TetId t, VertexId v) { return name(v) + " is in conflict with " + name(t); }

// The vertex of the neighbour across a facet that is not on the facet.
VertexId far_vertex(const Tetrahedralization& tets, FacetId f) {
  const FacetId mirror = tets.mirror(f);
  return tets.vertices(mirror.tet())[mirror.face()];
}

}  // namespace

Violation find_combinatorial_violation(const Tetrahedralization& tets) {
  const auto check = [&](TetId t) {
    Violation violation = check_vertices(tets, t);
    return violation ? violation : check_mirrors(tets, t);
  };
  if (Violation violation = first_violation(tets, check)) return violation;
  for (std::size_t i = 0; i < tets.vertex_count(); ++i) {
    if (!tets.is_live(VertexId(i))) continue;
    const TetId t = tets.incident_tet(VertexId(i));
    if (t.index() >= tets.tet_slots() || !tets.is_live(t) || !has_vertex(tets, t, VertexId(i))) {
      return name(VertexId(i)) + " has no live incident tetrahedron";
    }
  }
  return check_euler_relation(tets);
}

Violation find_orientation_violation(const Tetrahedralization& tets) {
  return first_violation(tets, [&](TetId t) -> Violation {
    const auto& v = tets.vertices(t);
    if (!tets.is_ghost(t)) {
      if (orient3d(tets.point(v[0]), tets.point(v[1]), tets.point(v[2]), tets.point(v[3])) > 0) return std::nullopt;
      return name(t) + " is not positively oriented";
    }
    for (unsigned face = 0; face < 3; ++face) {
      const VertexId far = far_vertex(tets, FacetId(t, face));
      if (orient3d(tets.point(v[0]), tets.point(v[1]), tets.point(v[2]), tets.point(far)) > 0) {
        return name(far) + " lies beyond the hull facet of " + name(t);
      }
    }
    return std::nullopt;
  });
}

Violation find_delaunay_violation(const Tetrahedralization& tets) {
  return first_violation(tets, [&](TetId t) -> Violation {
    for (unsigned face = 0; face < 4; ++face) {
      const VertexId far = far_vertex(tets, FacetId(t, face));
      if (far == kInfiniteVertex || (tets.is_ghost(t) && face == 3)) continue;
      if (in_conflict(tets, t, far)) return conflict(t, far);
    }
    return std::nullopt;
  });
}

Violation find_delaunay_violation_by_brute_force(const Tetrahedralization& tets) {
  return first_violation(tets, [&](TetId t) -> Violation {
    for (std::size_t i = 0; i < tets.vertex_count(); ++i) {
      if (!tets.is_live(VertexId(i)) || has_vertex(tets, t, VertexId(i))) continue;
      if (tets.is_ghost(t) && has_vertex(tets, tets.neighbour(t, 3), VertexId(i))) continue;
      if (in_conflict(tets, t, VertexId(i))) return conflict(t, VertexId(i));
    }
    return std::nullopt;
  });
}

Violation find_violation(const Tetrahedralization& tets) {
  if (Violation violation = find_combinatorial_violation(tets)) return violation;
  if (Violation violation = find_orientation_violation(tets)) return violation;
  return find_delaunay_violation(tets);
}

}  // namespace deliso
