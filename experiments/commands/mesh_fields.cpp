#include "experiments/commands/mesh_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "delaunay/constructions.h"
#include "raycast/isosurface.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"
#include "volume/filters/meshed_field.h"

namespace deliso {
namespace {

constexpr std::size_t kBlock = 1024;  // items of a task

template <class Work>
void for_each_index(std::size_t count, int threads, const Work& work) {
  run_tasks((count + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) work(i);
  });
}

MeshAttribute component_field(const TriangleMesh& mesh, int threads) {
  MeshAttribute field{"component", 1, true, {}};
  // A vertex without a triangle has none: 0.
  for (const std::uint32_t component : mesh_topology(mesh, threads).component_of_vertex)
    field.values.push_back(component == MeshTopology::kNoComponent ? 0 : component + 1.0);
  return field;
}

MeshAttribute stage_field(const TriangleMesh& mesh, const TriangleMesh& stage1) {
  const auto coordinates = [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); };
  std::vector<std::tuple<double, double, double>> of_stage1;
  for (const Vec3& p : stage1.points) of_stage1.push_back(coordinates(p));
  std::sort(of_stage1.begin(), of_stage1.end());
  MeshAttribute field{"stage", 1, true, {}};
  for (const Vec3& p : mesh.points)
    field.values.push_back(std::binary_search(of_stage1.begin(), of_stage1.end(), coordinates(p)) ? 1 : 2);
  return field;
}

// Measures of one mesh against its isosurface.
class FieldMeasurer {
 public:
  FieldMeasurer(const TriangleMesh& mesh, const Isosurface& isosurface, const Affine& from_grid, int threads)
      : mesh_(mesh), isosurface_(isosurface), inverse_(from_grid.inverse()), threads_(threads) {}

  [[nodiscard]] MeshAttribute h_of_triangles() const {
    MeshAttribute field{"h", 1, false, std::vector<double>(mesh_.triangles.size())};
    for_each_index(field.values.size(), threads_, [&](std::size_t t) { field.values[t] = h(t); });
    return field;
  }

  [[nodiscard]] MeshAttribute h_of_vertices(const MeshAttribute& of_triangles) const {
    MeshAttribute field{"h", 1, false, std::vector<double>(mesh_.points.size(), -1)};
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t])
        field.values[v] = std::max(field.values[v], of_triangles.values[t]);
    }
    return field;
  }

  [[nodiscard]] MeshAttribute gradients() const {
    const Vec3& step = isosurface_.step();
    const Vec3& spacing = isosurface_.grid().spacing();
    const Vec3 scale{step.x / spacing.x, step.y / spacing.y, step.z / spacing.z};
    MeshAttribute field{"gradient", 3, false, std::vector<double>(3 * mesh_.points.size())};
    for_each_index(mesh_.points.size(), threads_, [&](std::size_t v) {
      const Vec3 in_grid = scaled(scale, isosurface_.gradient(from_world(mesh_.points[v], isosurface_)));
      // Gradients change with the transposed inverse of the map of points.
      for (std::size_t axis = 0; axis < 3; ++axis) field.values[3 * v + axis] = dot(inverse_.columns[axis], in_grid);
    });
    return field;
  }

 private:
  [[nodiscard]] double h(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 p = from_world(mesh_.points[a], isosurface_);
    const Vec3 q = from_world(mesh_.points[b], isosurface_), r = from_world(mesh_.points[c], isosurface_);
    const Vec3 normal = cross(q - p, r - p);
    const double length = norm(normal);
    const Vec3 center = circumcircle(p, q, r).center;
    if (!(length > 0) || !is_finite(center)) return -1;
    SearchCounters ignored;
    const std::optional<double> hit =
        isosurface_.nearest_falling_hit({center, normal / length}, isosurface_.box().diagonal(), ignored);
    return hit ? std::abs(*hit) : -1;
  }

  const TriangleMesh& mesh_;
  const Isosurface& isosurface_;
  Affine inverse_;
  int threads_;
};

// quality and min_angle, in the grid's own coordinates.
std::pair<MeshAttribute, MeshAttribute> shape_fields(const TriangleMesh& mesh) {
  std::pair<MeshAttribute, MeshAttribute> fields{{"quality", 1, false, {}}, {"min_angle", 1, false, {}}};
  for (const auto& triangle : mesh.triangles) {
    double twice_area = 0, squares = 0, least = std::numbers::pi;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[triangle[i]];
      const Vec3 a = mesh.points[triangle[(i + 1) % 3]] - p, b = mesh.points[triangle[(i + 2) % 3]] - p;
      twice_area = norm_of_any_size(cross(a, b));
      squares += squared_norm(a);
      least = std::min(least, std::atan2(twice_area, dot(a, b)));
    }
    fields.first.values.push_back(squares > 0 ? 2 * std::numbers::sqrt3 * twice_area / squares : 0);
    fields.second.values.push_back(least * 180 / std::numbers::pi);
  }
  return fields;
}

}  // namespace

MeshAttributes mesh_fields(const MeshingResult& result, const ScalarGrid& grid, double isovalue,
                           const Parameters& parameters, const Affine& from_grid, int threads) {
  const MeshedField field = meshed_field(grid, isovalue, parameters.field, parameters.boundary == Boundary::kClosed,
                                         spacing_to_use(parameters, grid.spacing()), threads);
  const Isosurface isosurface(field.grid, result.isovalue_used, parameters.search,
                              spacing_to_use(parameters, field.grid.spacing()), threads);
  TriangleMesh falling = result.mesh;  // facing lower values
  if (parameters.field.invert) {
    for (auto& [a, b, c] : falling.triangles) std::swap(b, c);
  }
  const FieldMeasurer measurer(falling, isosurface, from_grid, threads);
  MeshAttributes fields;
  fields.vertices.push_back(component_field(result.mesh, threads));
  if (result.stage1_mesh) fields.vertices.push_back(stage_field(result.mesh, *result.stage1_mesh));
  MeshAttribute h = measurer.h_of_triangles();
  fields.vertices.push_back(measurer.h_of_vertices(h));
  fields.vertices.push_back(measurer.gradients());
  auto [quality, min_angle] = shape_fields(result.mesh);
  fields.triangles = {std::move(h), std::move(quality), std::move(min_angle)};
  return fields;
}

}  // namespace deliso
