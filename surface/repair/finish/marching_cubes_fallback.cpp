#include "surface/repair/finish/marching_cubes_fallback.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "delaunay/base/check.h"
#include "surface/certificate/component_assignment.h"
#include "surface/certificate/finer_cubes.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/intersection/self_intersection.h"
#include "surface/repair/lattice/cell_pieces.h"
#include "surface/restricted/poles.h"

namespace deliso {

namespace {

// The largest number of pairs whose pieces are examined in one pass.
constexpr std::size_t kMostPairs = 4096;

// Raises the heights of the vertices from `first` on.
void raise_pole_heights(SurfaceMesh& mesh, std::size_t first, const ExactSurface& surface) {
  const std::span<const Vec3> points = std::span(mesh.points).subspan(first);
  std::vector<VertexId> vertex_of;
  try {
    const SignedDelaunay triangulation(surface.isosurface, points, surface.threads, &vertex_of);
    const std::vector<bool> all(triangulation.delaunay().vertex_count(), true);
    const std::vector<double> heights = compute_poles(triangulation, all, PoleHeight::kNearer, surface.threads);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (vertex_of[i].is_none()) continue;
      double& height = mesh.pole_heights[first + i];
      height = std::max(height, heights[vertex_of[i].index()]);
    }
  } catch (const InputError&) {
    // All points on one line: crossings nearer to each other than numbers tell apart.
  }
}

// Takes these components from marching cubes instead. Pieces on no component go, too.
void replace(const std::vector<bool>& components, const PieceComponents& pieces, const ExactSurfaceCache& cache,
             const std::optional<CubeNearness>& nearness, SurfaceMesh& mesh) {
  drop_pieces(mesh, pieces, [&](std::uint32_t c) { return c == kNoComponent || components[c]; });
  append_cubes(cache, components, nearness, mesh);
}

}  // namespace

void append_cubes(const ExactSurfaceCache& cache, const std::vector<bool>& components,
                  const std::optional<CubeNearness>& nearness, SurfaceMesh& mesh,
                  std::vector<std::uint32_t>* component_of) {
  const std::size_t first = mesh.points.size();
  const auto append = [&](const ExactPolygonization& cubes, const std::vector<bool>& wanted) {
    append_pieces(cubes.mesh, cubes.component, wanted, mesh);
    if (component_of == nullptr) return;
    std::copy_if(cubes.component.begin(), cubes.component.end(), std::back_inserter(*component_of),
                 [&](std::uint32_t c) { return c < wanted.size() && wanted[c]; });
  };
  const ExactSurface& surface = cache.surface();
  std::vector<bool> rest = components;
  if (const GridFactors pieces = cell_pieces(surface.isosurface); pieces != GridFactors{1, 1, 1}) {
    const ExactPolygonization finer = finer_cubes(components, surface, pieces);
    append(finer, components);
    for (const std::uint32_t c : finer.component) rest[c] = false;
  }
  if (std::find(rest.begin(), rest.end(), true) != rest.end()) {
    append(nearness ? nearer_cubes(rest, surface, *nearness) : cache.polygonized(), rest);
  }
  raise_pole_heights(mesh, first, surface);
}

bool polygonize_misplaced_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache,
                                 const std::optional<CubeNearness>& nearness, std::vector<bool>& is_polygonized) {
  const AssignmentFaults faults = assignment_faults(mesh, cache.surface());
  if (faults.is_empty()) return false;
  std::vector<bool> replaced(is_polygonized.size(), false);
  faults.mark(replaced);
  faults.mark(is_polygonized);
  if (nearness) replaced = is_polygonized;
  replace(replaced, piece_components(mesh, cache.surface()), cache, nearness, mesh);
  return true;
}

void polygonize_crossing_pieces(SurfaceMesh& mesh, const ExactSurfaceCache& cache,
                                const std::optional<CubeNearness>& nearness, std::vector<bool>& is_polygonized,
                                Controls& controls) {
  while (!controls.poll()) {
    const SelfIntersections found =
        self_intersections(mesh.points, mesh.triangles, kMostPairs, cache.surface().threads);
    if (found.crossing_pairs == 0) return;
    const PieceComponents pieces = piece_components(mesh, cache.surface());
    std::vector<bool> replaced(is_polygonized.size(), false);
    for (const TrianglePair& pair : found.crossing) {
      for (const std::uint32_t t : {pair.first, pair.second}) {
        const std::uint32_t c = pieces.component_of(t);
        if (c != kNoComponent && !is_polygonized[c]) replaced[c] = is_polygonized[c] = true;
      }
    }
    if (std::find(replaced.begin(), replaced.end(), true) == replaced.end()) {
      // No further piece can be blamed. Inverted umbrellas may have been removed from pieces of marching cubes, so even
      // these may cross: take all components from marching cubes anew.
      is_polygonized.assign(is_polygonized.size(), true);
      mesh = cache.polygonized().mesh;
      return;
    }
    // Two components that share a cell are divided there together, or cross.
    if (nearness) replaced = is_polygonized;
    replace(replaced, pieces, cache, nearness, mesh);
  }
}

}  // namespace deliso
