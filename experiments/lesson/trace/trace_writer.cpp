#include "experiments/lesson/trace/trace_writer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "delaunay/constructions.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/refine/disk/refinement_disk.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

namespace {

const char* step_name(RecoverStep step) {
  switch (step) {
    case RecoverStep::kMultiIntersect:
      return "multi_intersect";
    case RecoverStep::kExtractManifold:
      return "extract_manifold";
    case RecoverStep::kApproximateGeometry:
      return "approximate_geometry";
    case RecoverStep::kCoverage:
      break;
  }
  return "coverage";
}

double shortest_edge(const std::array<Vec3, 3>& p) {
  return std::sqrt(
      std::min({squared_distance(p[0], p[1]), squared_distance(p[1], p[2]), squared_distance(p[2], p[0])}));
}

// The criterion of section 3.2 that a triangle is farthest beyond.
const char* worst_criterion(const TriangleMeasures& sigma, const Criteria& limits) {
  const std::array<std::pair<double, const char*>, 4> all = {
      {{unless_lapsed(badness1(sigma, limits), sigma, limits), "criterion1"},
       {unless_lapsed(badness2(sigma, limits), sigma, limits), "criterion2"},
       {badness3(sigma, limits), "criterion3"},
       {distance_badness(sigma, limits), "max_distance"}}};
  return std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; })
      ->second;
}

void add_mesh(const RefinementMesh& mesh, TraceEvent& event) {
  event["triangles"] = TraceEvent::array();
  event["points"] = TraceEvent::array();
  for (const auto& triangle : mesh.triangles) event["triangles"].push_back(triangle.corners);
  for (const auto& vertex : mesh.vertices) event["points"].push_back(array_of(vertex.point));
}

}  // namespace

int TraceWriter::number(VertexId v) const { return v == kInfiniteVertex ? -1 : number_[v.index()]; }

std::array<int, 4> TraceWriter::corners(const RestrictedDelaunay& del_s, TetId t) const {
  const auto& v = del_s.delaunay().vertices(t);
  return {number(v[0]), number(v[1]), number(v[2]), number(v[3])};
}

std::array<int, 3> TraceWriter::corners(const RestrictedDelaunay& del_s, FacetId f) const {
  const auto v = del_s.delaunay().facet_vertices(f);
  return {number(v[0]), number(v[1]), number(v[2])};
}

TraceEvent TraceWriter::facet(const DualEdge& edge) const {
  TraceEvent hits = TraceEvent::array();
  for (const Hit& hit : edge.hits) hits.push_back(hit.t);
  return TraceEvent::array({number(edge.vertices[0]), number(edge.vertices[1]), number(edge.vertices[2]), hits});
}

void TraceWriter::triangulated(const RestrictedDelaunay& del_s) {
  const Tetrahedralization& delaunay = del_s.delaunay();
  vertices_ = static_cast<int>(delaunay.vertex_count());
  number_.resize(delaunay.vertex_count());
  TraceEvent event{{"e", "initial"}, {"points", array_of(delaunay.points())}, {"virtual", TraceEvent::array()}};
  for (std::size_t v = 0; v < number_.size(); ++v) {
    number_[v] = static_cast<int>(v);
    if (del_s.is_virtual(VertexId(v))) event["virtual"].push_back(v);
  }
  TraceEvent tets = TraceEvent::array(), facets = TraceEvent::array();
  std::string above;
  for (std::size_t t = 0; t < delaunay.tet_slots(); ++t) {
    if (!delaunay.is_live(TetId(t))) continue;
    tets.push_back(corners(del_s, TetId(t)));
    above += del_s.is_above(TetId(t)) ? '1' : '0';
  }
  for (std::size_t e = 0; e < del_s.dual_edge_slots(); ++e) {
    if (del_s.is_alive(DualEdgeId(e))) facets.push_back(facet(del_s.dual_edge(DualEdgeId(e))));
  }
  event["tets"] = std::move(tets);
  event["above"] = above;
  event["facets"] = std::move(facets);
  sink_(event);
}

void TraceWriter::violation(const RestrictedDelaunay& del_s, const ObservedViolation& violation) {
  pending_ = {{"e", "insert"}, {"why", step_name(violation.step)}};
  if (violation.sigma != nullptr) {
    const DualEdge& sigma = *violation.sigma;
    const auto point = [&](unsigned i) { return del_s.delaunay().point(sigma.vertices[i]); };
    pending_["sigma"] = facet(sigma);
    pending_["r"] = sigma.radius;
    pending_["l"] = shortest_edge({point(0), point(1), point(2)});
    if (violation.step == RecoverStep::kApproximateGeometry) pending_["h"] = std::abs(surface_hit(sigma));
  }
  if (!violation.umbrella.is_none()) {
    pending_["q"] = number(violation.umbrella);
    TraceEvent disk = TraceEvent::array();
    for (const FacetId f : violation.disk) disk.push_back(corners(del_s, f));
    pending_["disk"] = std::move(disk);
  }
}

void TraceWriter::cavity(const RestrictedDelaunay& del_s, const Vec3& p) {
  TraceEvent gone = TraceEvent::array();
  for (const TetId t : del_s.conflict_region()) gone.push_back(corners(del_s, t));
  rim_had_hits_.clear();
  for (const FacetId f : del_s.rim()) rim_had_hits_.push_back(!del_s.dual_edge_of(f).is_none());
  pending_["v"] = vertices_;
  pending_["p"] = array_of(p);
  pending_["gone"] = std::move(gone);
}

// Of each new tetrahedron, in the order of the rim's sorted facets.
std::string TraceWriter::signs_of_star(const RestrictedDelaunay& del_s) const {
  std::vector<std::pair<std::array<int, 3>, char>> star;
  for (const TetId t : del_s.created()) {
    std::array<int, 3> rim = corners(del_s, FacetId(t, 0));
    std::sort(rim.begin(), rim.end());
    star.emplace_back(rim, del_s.is_above(t) ? '1' : '0');
  }
  std::sort(star.begin(), star.end());
  std::string above;
  for (const auto& [rim, sign] : star) above += sign;
  return above;
}

TraceEvent TraceWriter::changed_facets(const RestrictedDelaunay& del_s) const {
  TraceEvent facets = TraceEvent::array();
  for (const DualEdgeId e : del_s.touched_edges()) {
    if (del_s.is_alive(e)) facets.push_back(facet(del_s.dual_edge(e)));
  }
  for (std::size_t i = 0; i < rim_had_hits_.size(); ++i) {
    const FacetId f(del_s.created()[i], 0);
    if (!rim_had_hits_[i] || !del_s.dual_edge_of(f).is_none()) continue;
    const auto [a, b, c] = corners(del_s, f);
    facets.push_back(TraceEvent::array({a, b, c, TraceEvent::array()}));
  }
  return facets;
}

void TraceWriter::inserted(const RestrictedDelaunay& del_s) {
  const VertexId v = del_s.last_vertex();
  if (number_.size() <= v.index()) number_.resize(v.index() + 1, -1);
  number_[v.index()] = vertices_++;
  pending_["above"] = signs_of_star(del_s);
  pending_["facets"] = changed_facets(del_s);
  sink_(std::exchange(pending_, {}));
}

void TraceWriter::refused(const RestrictedDelaunay& /*del_s*/, std::string_view cause) {
  pending_["e"] = "refuse";
  pending_["cause"] = cause;
  sink_(std::exchange(pending_, {}));
}

void TraceWriter::renamed(std::span<const VertexId> renamed) {
  std::vector<int> numbers(number_.size(), -1);
  for (std::size_t v = 0; v < std::min(renamed.size(), number_.size()); ++v) {
    if (!renamed[v].is_none()) numbers[renamed[v].index()] = number_[v];
  }
  number_ = std::move(numbers);
}

void TraceWriter::round_begins(const ObservedComparison& comparison, std::span<const std::uint64_t> cells) {
  if (!has_compared_) sink_(comparison_event(comparison));
  sink_(sampling_event(comparison.levels, cells));
}

void TraceWriter::round_ends(const ObservedComparison& comparison) {
  sink_(comparison_event(comparison));
  has_compared_ = true;
}

void TraceWriter::meshed(const SurfaceMesh& mesh, const Criteria& limits) {
  limits_ = limits;
  has_restarted_ = false;
  told_ = mesh;
  sink_(
      {{"e", "mesh"},
       {"points", array_of(mesh.points)},
       {"poles", mesh.pole_heights},
       {"triangles", mesh.triangles},
       {"limits",
        {{"epsilon1", limits.epsilon}, {"epsilon2", limits.epsilon2}, {"rho", limits.rho}, {"r_min", limits.r_min}}}});
}

void TraceWriter::disk(const RefinementMesh& mesh, const RefinementDisk& e, const RefinementCandidate& candidate) {
  pending_ = {};
  const RefinementMesh::Triangle& seed = mesh.triangles[candidate.seed];
  const std::array<Vec3, 3> p = mesh.corner_points(seed.corners);
  const Circumcircle circle = circumcircle(p[0], p[1], p[2]);
  TriangleMeasures sigma{.h = distance(circle.center, seed.ball.center), .r = circle.radius, .l = shortest_edge(p)};
  for (const std::uint32_t v : seed.corners) sigma.h_mean += mesh.vertices[v].pole_height / 3;
  const char* why = worst_criterion(sigma, limits_);
  if (candidate.split != kNoSide) why = "boundary";
  if (candidate.halved != kNoSide) why = "halving";
  if (candidate.is_coverage_target) why = "coverage";
  TraceEvent gone = TraceEvent::array(), rim = TraceEvent::array();
  for (const std::uint32_t t : e.triangles()) gone.push_back(mesh.triangles[t].corners);
  for (const RimEdge& edge : e.rim()) rim.push_back(edge.from);
  const bool is_closed = candidate.split == kNoSide;
  if (!is_closed) rim.push_back(e.rim().back().to);
  sink_({{"e", "refine"},
         {"t", seed.corners},
         {"why", why},
         {"h", sigma.h},
         {"r", sigma.r},
         {"l", sigma.l},
         {"pole", sigma.h_mean},
         {"v", mesh.vertices.size()},
         {"p", array_of(candidate.point)},
         {"gone", std::move(gone)},
         {"rim", std::move(rim)},
         {"closed", is_closed}});
}

void TraceWriter::attempt_refused(const RefinementMesh& mesh, const RefinementDisk& e,
                                  const RefinementCandidate& candidate) {
  TraceEvent gone = TraceEvent::array();
  for (const std::uint32_t t : e.triangles()) gone.push_back(mesh.triangles[t].corners);
  pending_ = {{"e", "keep"}, {"p", array_of(candidate.point)}, {"gone", std::move(gone)}};
}

void TraceWriter::disk_refused(const RefinementMesh& mesh, std::uint32_t triangle, std::string_view cause) {
  TraceEvent event = std::exchange(pending_, {});
  event["e"] = "keep";
  event["t"] = mesh.triangles[triangle].corners;
  event["cause"] = cause;
  sink_(event);
}

void TraceWriter::improved(const RefinementMesh& mesh, std::string_view why) {
  TraceEvent event{{"e", "shape"}, {"why", why}};
  add_mesh(mesh, event);
  sink_(event);
}

void TraceWriter::restarted() {
  has_restarted_ = true;
  sink_({{"e", "restart"}});
}

// After a restart the mesh may be that of an earlier attempt, so it is written.
void TraceWriter::refined(const RefinementMesh& mesh) {
  TraceEvent event{{"e", "refined"}, {"vertices", mesh.vertices.size()}};
  if (!has_restarted_) {
    event["triangles"] = mesh.triangles.size();
  } else {
    add_mesh(mesh, event);
  }
  sink_(event);
  told_ = {};
  for (const auto& triangle : mesh.triangles) told_.triangles.push_back(triangle.corners);
  for (const auto& vertex : mesh.vertices) told_.points.push_back(vertex.point);
}

void TraceWriter::reshaped(const SurfaceMesh& mesh) {
  sink_({{"e", "shape"}, {"points", array_of(mesh.points)}, {"triangles", mesh.triangles}});
  told_ = mesh;
}

// A run without stage 2 has told of no mesh, and does not end with one.
void TraceWriter::finished(const SurfaceMesh& mesh) {
  if (told_.triangles.empty() || (mesh.points == told_.points && mesh.triangles == told_.triangles)) return;
  sink_({{"e", "shape"}, {"why", "rest"}, {"points", array_of(mesh.points)}, {"triangles", mesh.triangles}});
}

void TraceWriter::certified(const PromiseFigures& figures, const Promise& promise) {
  sink_(certificate_event(figures, promise));
}

}  // namespace deliso
