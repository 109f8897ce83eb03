#include "surface/recover/init_triangulation.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "surface/recover/boundary_curves.h"
#include "surface/recover/component_seeds.h"

namespace deliso {

namespace {

// At most so many random points are triangulated in one batch, which cannot be stopped; further points are inserted one
// by one.
constexpr std::size_t kMostAtOnce = 20'000;

void check_enough(const std::vector<Vec3>& points, const InitialParameters& initial) {
  constexpr std::size_t kFewest = 3;  // not in line
  if (initial.seeding == Seeding::kRandom && points.size() < kFewest) {
    throw InputError("too few points of the isosurface to start from: initial.random_points is " +
                     std::to_string(initial.random_points) + ", with initial.seeding \"random\" it should be about 20");
  }
  if (points.empty()) throw InputError("the isosurface has no point to start from");
}

void insert_further(RestrictedDelaunay& restricted, const std::vector<Vec3>& points, Controls& controls) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t vertices = restricted.delaunay().vertex_count();
    if (controls.must_stop("initial", vertices, points.size() - i)) return;
    restricted.insert(points[i], restricted.delaunay().incident_tet(restricted.last_vertex()), 0);
  }
}

}  // namespace

std::unique_ptr<RestrictedDelaunay> init_triangulation(const ExactSurface& surface, const Parameters& parameters,
                                                       std::uint64_t seed, Controls& controls,
                                                       SearchCounters& counters) {
  const InitialParameters& initial = parameters.initial;
  const Isosurface& isosurface = surface.isosurface;
  Rng rng(seed);
  std::vector<Vec3> points = random_ray_points(isosurface, initial.random_points, rng, counters, &controls);
  const auto first_further = points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), kMostAtOnce));
  std::vector<Vec3> further(first_further, points.end());
  points.erase(first_further, points.end());
  const std::vector<Vec3> curves = boundary_curve_points(isosurface);
  points.insert(points.end(), curves.begin(), curves.end());
  if (initial.seeding == Seeding::kComponents) {
    const std::vector<Vec3> seeds = component_seeds(surface);
    points.insert(points.end(), seeds.begin(), seeds.end());
  }
  check_enough(points, initial);

  const FacetRule rule = parameters.stage1.one_sign_per_tetrahedron ? FacetRule::kSigns : FacetRule::kHits;
  auto restricted = std::make_unique<RestrictedDelaunay>(isosurface, points, rule, surface.threads);
  insert_further(*restricted, further, controls);
  return restricted;
}

}  // namespace deliso
