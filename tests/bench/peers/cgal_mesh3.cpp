// CGAL Mesh_3, facets only, of the trilinear interpolant of a gray image.
//
// As its manual recommends: seeds in every component of the image (initialize_triangulation_from_gray_image), a facet
// angle of 30 degrees, which its proof of termination allows at most, manifold facets, no optimization of cells, since
// there are no criteria for cells.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/ImageIO.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/initialize_triangulation_from_gray_image.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/version.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "tests/bench/peers/peer.h"

namespace {

using namespace deliso;
using namespace deliso::peers;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr float kOutside = -1e30F;

std::shared_ptr<CGAL::Image_3> image_of(const ScalarGrid& grid) {
  const auto& dims = grid.dims();
  const Vec3& s = grid.spacing();
  _image* image = _createImage(static_cast<std::size_t>(dims[0]), static_cast<std::size_t>(dims[1]),
                               static_cast<std::size_t>(dims[2]), 1, s.x, s.y, s.z, 4, WK_FLOAT, SGN_SIGNED);
  auto* samples = static_cast<float*>(image->data);
  for (int k = 0; k < dims[2]; ++k) {
    for (int j = 0; j < dims[1]; ++j) {
      for (int i = 0; i < dims[0]; ++i) *samples++ = static_cast<float>(grid.at(i, j, k));
    }
  }
  return std::make_shared<CGAL::Image_3>(image);
}

// Facets as seen from outside, where values are lower: a facet's triple is seen from within its cell.
TriangleMesh boundary_of(const Complex& complex, const Vec3& origin) {
  TriangleMesh mesh;
  std::unordered_map<Triangulation::Vertex_handle, std::uint32_t> number;
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end(); ++facet) {
    auto [cell, index] = *facet;
    if (complex.is_in_complex(cell)) {
      const auto other = complex.triangulation().mirror_facet(*facet);
      cell = other.first;
      index = other.second;
    }
    std::array<std::uint32_t, 3> triangle{};
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = cell->vertex(Triangulation::vertex_triple_index(index, corner));
      const auto [found, is_new] = number.try_emplace(vertex, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) {
        const auto& p = vertex->point();
        mesh.points.push_back({p.x() + origin.x, p.y() + origin.y, p.z() + origin.z});
      }
      triangle[static_cast<std::size_t>(corner)] = found->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::function<Trial(const Sizes&)> prepare(const ScalarGrid& grid, const Arguments& arguments) {
  const double isovalue = arguments.isovalue;
  using namespace CGAL::parameters;
  const auto image = image_of(grid);
  const Vec3 origin = grid.origin();
  const double voxel = std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z});
  return [image, origin, voxel, isovalue](const Sizes& sizes) {
    CGAL::get_default_random() = CGAL::Random(0);
    const auto begin = std::chrono::steady_clock::now();
    const Domain domain = Domain::create_gray_image_mesh_domain(*image, iso_value = static_cast<float>(isovalue),
                                                                value_outside = kOutside, relative_error_bound = 1e-6);
    const Criteria criteria(facet_angle = 30, facet_size = sizes.radius * voxel,
                            facet_distance = sizes.distance * voxel, facet_topology = CGAL::MANIFOLD);
    Complex complex;
    initialize_triangulation_from_gray_image(complex, domain, *image, criteria, static_cast<float>(isovalue), float());
    CGAL::refine_mesh_3(complex, domain, criteria, no_perturb(), no_exude(), manifold());
    Trial trial;
    trial.mesh = boundary_of(complex, origin);
    trial.seconds = seconds_since(begin);
    return trial;
  };
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, "CGAL " CGAL_VERSION_STR ", Mesh_3",
             "facet angle 30, seeds in every component of the image, manifold facets", prepare);
}
