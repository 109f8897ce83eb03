// A triangle mesh as a shape, drawn with its edges.
#pragma once

#include "experiments/pictures/shape.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/search/box_tree.h"

namespace deliso {

class MeshShape : public Shape {
 public:
  explicit MeshShape(TriangleMesh mesh);

  // Rays do not pass between neighbouring triangles: the test of S. Woop, C. Benthin and I. Wald, Watertight
  // Ray/Triangle Intersection, Journal of Computer Graphics Techniques 2(1), 2013. Normals are those of the triangles.
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Line& ray, double t0, double t1) const override;
  [[nodiscard]] double edge_distance(std::uint32_t element, const Camera& camera, double x, double y) const override;
  [[nodiscard]] double element_size(std::uint32_t element, const Camera& camera) const override;
  [[nodiscard]] const Box3& box() const override { return box_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  [[nodiscard]] const Vec3& corner(std::uint32_t triangle, std::size_t i) const {
    return mesh_.points[mesh_.triangles[triangle][i]];
  }

  TriangleMesh mesh_;
  BoxTree tree_;
  Box3 box_;
};

}  // namespace deliso
