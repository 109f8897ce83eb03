#include "surface/certificate/component_assignment.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "delaunay/base/counted.h"
#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/component_match.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/certificate/promise.h"

namespace deliso {

namespace {

void sort_and_drop_repeated(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Whether a piece is no larger than vertices may be off the isosurface.
bool is_tiny(const AssignedPieces& pieces, std::uint32_t piece) {
  Box3 box;
  for (std::size_t v = 0; v < pieces.points.size(); ++v) {
    if (pieces.piece_of[v] == piece) box.extend(pieces.points[v]);
  }
  return !pieces.points.empty() && box.diagonal() < Promise().max_residual;
}

}  // namespace

AssignmentFaults assignment_faults(const AssignedPieces& pieces) {
  const std::vector<ComponentShare> shares =
      component_shares(pieces.piece_of, pieces.component_of, pieces.topology.size());
  const std::vector<ComponentShare> main_of_piece = largest_shares_of_pieces(shares, pieces.topology.size());
  const std::vector<ComponentShare> own = largest_shares(main_of_piece, pieces.components.size(),
                                                         [](const ComponentShare& share) { return share.component; });

  AssignmentFaults faults;
  for (std::uint32_t c = 0; c < own.size(); ++c) {
    if (own[c].vertices == 0) {
      faults.without.push_back(c);
    } else if (pieces.topology[own[c].piece] != pieces.components[c]) {
      faults.unlike.push_back(c);
    }
  }
  for (std::uint32_t piece = 0; piece < main_of_piece.size(); ++piece) {
    const ComponentShare& main = main_of_piece[piece];
    if (main.vertices > 0 && own[main.component].piece != piece) faults.repeated.push_back(main.component);
  }
  for (const ComponentShare& share : shares) {
    const std::uint32_t counts_for = main_of_piece[share.piece].component;
    if (share.component == counts_for || share.vertices < own[share.component].vertices) continue;
    if (own[share.component].vertices > 0 && is_tiny(pieces, own[share.component].piece)) continue;
    faults.overrunning.push_back(counts_for);
  }
  sort_and_drop_repeated(faults.repeated);
  sort_and_drop_repeated(faults.overrunning);
  return faults;
}

void add_assignment_faults(const AssignmentFaults& faults, Certificate& certificate) {
  const auto add = [&](const std::vector<std::uint32_t>& components, const std::string& one,
                       const std::string& several) {
    if (components.empty()) return;
    if (certificate.verdict == Verdict::kHomeomorphic) certificate.verdict = Verdict::kDifferent;
    certificate.differences.push_back(counted(static_cast<std::int64_t>(components.size()), one, several));
  };
  add(faults.without, "component of the isosurface has no piece of the mesh on it.",
      "components of the isosurface have no piece of the mesh on them.");
  add(faults.repeated, "component of the isosurface has several pieces of the mesh on it.",
      "components of the isosurface have several pieces of the mesh on them.");
  add(faults.unlike, "component of the isosurface has a piece of another topology on it.",
      "components of the isosurface have pieces of another topology on them.");
  add(faults.overrunning, "piece of the mesh lies on several components of the isosurface.",
      "pieces of the mesh lie on several components of the isosurface each.");
}

std::vector<std::uint32_t> components_of(std::span<const Vec3> points, const ScalarGrid& grid, double isovalue,
                                         const IsosurfaceTopology& topology, int threads) {
  std::vector<std::uint32_t> components(points.size());
  for_each_block(points.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      components[i] = component_of(grid, isovalue, topology, points[i]).value_or(kNoComponent);
    }
  });
  return components;
}

AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface) {
  std::vector<std::uint32_t> component_of;
  std::vector<Vec3> points;
  ComponentMatch match;
  run_tasks(2, surface.threads, [&](std::size_t task) {
    if (task == 0) {
      match = find_pieces(mesh);
    } else {
      const Vec3& step = surface.isosurface.step();
      points.reserve(mesh.points.size());
      for (const Vec3& p : mesh.points) points.push_back({p.x / step.x, p.y / step.y, p.z / step.z});
      component_of =
          components_of(points, surface.grid(), surface.isosurface.isovalue(), surface.topology, surface.threads);
    }
  });
  std::vector<ComponentTopology> topologies;
  topologies.reserve(match.pieces.size());
  for (const MeshPiece& piece : match.pieces) topologies.push_back(piece.topology);
  return assignment_faults({match.piece_of, component_of, topologies, surface.topology.components, points});
}

}  // namespace deliso
