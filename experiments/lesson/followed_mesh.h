// The mesh of stage 2 as the events of a trace make it, so that an event that ends it can say what is other than
// before, instead of the whole mesh.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "experiments/config/json.h"

namespace deliso {

class FollowedMesh {
 public:
  // The next event of the trace, with its coordinates rounded as the page has them.
  void follow(const Json& event);

  // `shape` as changes: {"e", "count": of vertices, "at": vertices that moved or are new, "points": where they are,
  // "come", "gone": triangles}. As it is where most is other than before.
  [[nodiscard]] Json changes(const Json& shape) const;

 private:
  // Corners in the order of the mesh, the smallest number first.
  using Triangle = std::array<std::int32_t, 3>;
  static Triangle triangle_of(const Json& corners);
  void refine(const Json& event);

  std::vector<Json> points_;
  std::set<Triangle> triangles_;
  std::vector<Json> first_points_;  // of the mesh that stage 2 begins with
  std::set<Triangle> first_triangles_;
};

}  // namespace deliso
