// CGAL Surface_mesher (make_surface_mesh) of the trilinear interpolant as an implicit function.
//
// As its manual recommends: an angular bound of 30 degrees, a sphere around the surface whose centre is inside, the
// manifold tag. It starts from points on random rays: twenty are its default, FIRST_POINTS others; every component
// needs one, and a mesh has them all.
#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/version.h>

#include <algorithm>
#include <unordered_map>

#include "tests/bench/peers/peer.h"

namespace {

using namespace deliso;
using namespace deliso::peers;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Complex = CGAL::Complex_2_in_triangulation_3<Triangulation>;
using Traits = Triangulation::Geom_traits;
using Point = Traits::Point_3;

constexpr int kFirstPoints = 20;  // CGAL's default

// Negative inside. Beyond the box everything is outside.
class Field {
 public:
  using result_type = double;
  Field(const ScalarGrid& grid, double isovalue) : grid_(&grid), isovalue_(isovalue) {}

  double operator()(const Point& p) const {
    const Vec3& s = grid_->spacing();
    const Vec3& o = grid_->origin();
    const double x = (p.x() - o.x) / s.x;
    const double y = (p.y() - o.y) / s.y;
    const double z = (p.z() - o.z) / s.z;
    const auto& n = grid_->dims();
    if (!(x >= 0 && y >= 0 && z >= 0 && x <= n[0] - 1 && y <= n[1] - 1 && z <= n[2] - 1)) return 1;
    const int i = std::min(static_cast<int>(x), n[0] - 2);
    const int j = std::min(static_cast<int>(y), n[1] - 2);
    const int k = std::min(static_cast<int>(z), n[2] - 2);
    const auto row = [&](int dj, int dk) {
      const double low = grid_->at(i, j + dj, k + dk);
      return low + (x - i) * (grid_->at(i + 1, j + dj, k + dk) - low);
    };
    const double near = row(0, 0) + (y - j) * (row(1, 0) - row(0, 0));
    const double far = row(0, 1) + (y - j) * (row(1, 1) - row(0, 1));
    return isovalue_ - (near + (z - k) * (far - near));
  }

 private:
  const ScalarGrid* grid_;
  double isovalue_;
};

// The sample inside that is nearest to the middle of the box.
Point inner_point(const ScalarGrid& grid, double isovalue) {
  const auto& n = grid.dims();
  const Vec3& s = grid.spacing();
  const Vec3& o = grid.origin();
  double best = 1e300;
  Point point;
  for (int k = 1; k + 1 < n[2]; ++k) {
    for (int j = 1; j + 1 < n[1]; ++j) {
      for (int i = 1; i + 1 < n[0]; ++i) {
        if (grid.at(i, j, k) <= isovalue) continue;
        const double x = i - 0.5 * (n[0] - 1), y = j - 0.5 * (n[1] - 1), z = k - 0.5 * (n[2] - 1);
        const double distance = x * x + y * y + z * z;
        if (distance >= best) continue;
        best = distance;
        point = Point(o.x + i * s.x, o.y + j * s.y, o.z + k * s.z);
      }
    }
  }
  return point;
}

TriangleMesh surface_of(const Complex& complex, const Field& field) {
  TriangleMesh mesh;
  std::unordered_map<Triangulation::Vertex_handle, std::uint32_t> number;
  const Triangulation& triangulation = complex.triangulation();
  for (auto facet = triangulation.finite_facets_begin(); facet != triangulation.finite_facets_end(); ++facet) {
    if (!complex.is_in_complex(*facet)) continue;
    // A facet's triple is seen from within its cell; it shall be seen from the side of lower values.
    auto [cell, index] = *facet;
    const bool is_outside = triangulation.is_infinite(cell) || field(triangulation.dual(cell)) > 0;
    std::array<std::uint32_t, 3> triangle{};
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = cell->vertex(Triangulation::vertex_triple_index(index, corner));
      const auto [found, is_new] = number.try_emplace(vertex, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back({vertex->point().x(), vertex->point().y(), vertex->point().z()});
      triangle[static_cast<std::size_t>(corner)] = found->second;
    }
    if (!is_outside) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::function<Trial(const Sizes&)> prepare(const ScalarGrid& grid, const Arguments& arguments) {
  const double isovalue = arguments.isovalue;
  const int first_points = arguments.first_points > 0 ? arguments.first_points : kFirstPoints;
  const Field field(grid, isovalue);
  const Point center = inner_point(grid, isovalue);
  const Vec3 across = grid.box().high - grid.box().low;
  const double radius = std::sqrt(across.x * across.x + across.y * across.y + across.z * across.z);
  const double voxel = std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z});
  return [field, center, radius, voxel, first_points](const Sizes& sizes) {
    CGAL::get_default_random() = CGAL::Random(0);
    const auto begin = std::chrono::steady_clock::now();
    Triangulation triangulation;
    Complex complex(triangulation);
    const CGAL::Implicit_surface_3<Traits, Field> surface(field, Traits::Sphere_3(center, radius * radius), 1e-6);
    const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30, sizes.radius * voxel,
                                                                        sizes.distance * voxel);
    CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag(), first_points);
    Trial trial;
    trial.mesh = surface_of(complex, field);
    trial.seconds = seconds_since(begin);
    return trial;
  };
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, "CGAL " CGAL_VERSION_STR ", Surface_mesher", "angle 30, manifold", prepare);
}
