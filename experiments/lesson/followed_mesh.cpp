#include "experiments/lesson/followed_mesh.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace deliso {

FollowedMesh::Triangle FollowedMesh::triangle_of(const Json& corners) {
  Triangle triangle = {corners.at(0).get<std::int32_t>(), corners.at(1).get<std::int32_t>(),
                       corners.at(2).get<std::int32_t>()};
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// E gives way to the star of the new vertex over its rim.
void FollowedMesh::refine(const Json& event) {
  for (const Json& triangle : event.at("gone")) triangles_.erase(triangle_of(triangle));
  const Json& rim = event.at("rim");
  const std::size_t edges = event.at("closed").get<bool>() ? rim.size() : rim.size() - 1;
  for (std::size_t i = 0; i < edges; ++i) {
    triangles_.insert(triangle_of(Json::array({event.at("v"), rim.at(i), rim.at((i + 1) % rim.size())})));
  }
  points_.push_back(event.at("p"));
}

void FollowedMesh::follow(const Json& event) {
  const Json& kind = event.at("e");
  if (kind == "refine") return refine(event);
  if (kind == "restart") {
    points_ = first_points_;
    triangles_ = first_triangles_;
  } else if (event.contains("points") && event.contains("triangles")) {
    points_ = event.at("points").get<std::vector<Json>>();
    triangles_.clear();
    for (const Json& triangle : event.at("triangles")) triangles_.insert(triangle_of(triangle));
  }
  if (kind != "mesh") return;
  first_points_ = points_;
  first_triangles_ = triangles_;
}

Json FollowedMesh::changes(const Json& shape) const {
  const Json& points = shape.at("points");
  Json at = Json::array(), moved = Json::array(), come = Json::array(), gone = Json::array();
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (v < points_.size() && points_[v] == points[v]) continue;
    at.push_back(v);
    moved.push_back(points[v]);
  }
  std::set<Triangle> left = triangles_;
  for (const Json& corners : shape.at("triangles")) {
    if (left.erase(triangle_of(corners)) == 0) come.push_back(corners);
  }
  for (const Triangle& triangle : left) gone.push_back(triangle);
  if (2 * at.size() > points.size() || 2 * come.size() > shape.at("triangles").size()) return shape;
  Json changes = {{"e", "shape"},
                  {"count", points.size()},
                  {"at", std::move(at)},
                  {"points", std::move(moved)},
                  {"come", std::move(come)},
                  {"gone", std::move(gone)}};
  if (shape.contains("why")) changes["why"] = shape.at("why");
  return changes;
}

}  // namespace deliso
