#include "surface/certificate/component_assignment.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "delaunay/base/counted.h"
#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/component_match.h"

namespace deliso {

namespace {

// How many vertices of a piece lie on a component.
struct Share {
  std::uint32_t piece = 0, component = 0;
  std::int64_t vertices = 0;
};

// All that are not zero, by piece and component.
std::vector<Share> shares_of(const AssignedPieces& pieces) {
  std::vector<Share> shares;
  for (std::size_t v = 0; v < pieces.piece_of.size(); ++v) {
    const std::uint32_t piece = pieces.piece_of[v], component = pieces.component_of[v];
    if (piece >= pieces.topology.size() || component >= pieces.components.size()) continue;
    if (shares.empty() || shares.back().piece != piece || shares.back().component != component) {
      shares.push_back({piece, component, 0});
    }
    ++shares.back().vertices;
  }
  const auto place = [](const Share& share) { return std::pair(share.piece, share.component); };
  std::sort(shares.begin(), shares.end(), [&](const Share& a, const Share& b) { return place(a) < place(b); });
  std::size_t count = 0;
  for (const Share& share : shares) {
    if (count > 0 && place(shares[count - 1]) == place(share)) {
      shares[count - 1].vertices += share.vertices;
    } else {
      shares[count++] = share;
    }
  }
  shares.resize(count);
  return shares;
}

// For each number below `count` the largest of the shares that have it, the first of equals.
template <class NumberOf>
std::vector<Share> largest(const std::vector<Share>& shares, std::size_t count, const NumberOf& number_of) {
  std::vector<Share> most(count);
  for (const Share& share : shares) {
    Share& so_far = most[number_of(share)];
    if (share.vertices > so_far.vertices) so_far = share;
  }
  return most;
}

void sort_and_drop_repeated(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

AssignmentFaults assignment_faults(const AssignedPieces& pieces) {
  const std::vector<Share> shares = shares_of(pieces);
  const std::vector<Share> main_of_piece =
      largest(shares, pieces.topology.size(), [](const Share& share) { return share.piece; });
  const std::vector<Share> own =
      largest(main_of_piece, pieces.components.size(), [](const Share& share) { return share.component; });

  AssignmentFaults faults;
  for (std::uint32_t c = 0; c < own.size(); ++c) {
    if (own[c].vertices == 0) {
      faults.without.push_back(c);
    } else if (pieces.topology[own[c].piece] != pieces.components[c]) {
      faults.unlike.push_back(c);
    }
  }
  for (std::uint32_t piece = 0; piece < main_of_piece.size(); ++piece) {
    const Share& main = main_of_piece[piece];
    if (main.vertices > 0 && own[main.component].piece != piece) faults.repeated.push_back(main.component);
  }
  for (const Share& share : shares) {
    const std::uint32_t counts_for = main_of_piece[share.piece].component;
    if (share.component == counts_for || share.vertices < own[share.component].vertices) continue;
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
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> components(points.size());
  for_each_block(points.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      components[i] = component_of(grid, isovalue, topology, points[i]).value_or(kNone);
    }
  });
  return components;
}

AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface) {
  std::vector<std::uint32_t> component_of;
  ComponentMatch match;
  run_tasks(2, surface.threads, [&](std::size_t task) {
    if (task == 0) {
      match = find_pieces(mesh);
    } else {
      const Vec3& step = surface.isosurface.step();
      std::vector<Vec3> points;
      points.reserve(mesh.points.size());
      for (const Vec3& p : mesh.points) points.push_back({p.x / step.x, p.y / step.y, p.z / step.z});
      component_of =
          components_of(points, surface.grid(), surface.isosurface.isovalue(), surface.topology, surface.threads);
    }
  });
  std::vector<ComponentTopology> topologies;
  topologies.reserve(match.pieces.size());
  for (const MeshPiece& piece : match.pieces) topologies.push_back(piece.topology);
  return assignment_faults({match.piece_of, component_of, topologies, surface.topology.components});
}

}  // namespace deliso
