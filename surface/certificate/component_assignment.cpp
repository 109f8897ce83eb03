#include "surface/certificate/component_assignment.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "delaunay/base/counted.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/certificate/promise.h"
#include "volume/topology/component_blocks.h"

namespace deliso {

namespace {

constexpr std::size_t kCrossingsPerPoint = 8;

void sort_and_drop_repeated(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// The vertices of a share that tell what they lie on; counted no further than to `enough`.
std::int64_t certain_vertices(const AssignedPieces& pieces, const ComponentShare& share, std::int64_t enough) {
  std::int64_t count = 0;
  for (std::uint32_t v = 0; v < pieces.piece_of.size() && count < enough; ++v) {
    const bool is_counted = pieces.piece_of[v] == share.piece && pieces.component_of[v] == share.component;
    count += is_counted && !pieces.is_doubtful(v) ? 1 : 0;
  }
  return count;
}

// The pieces of a mesh, and where they lie: points are in index space, and may be off the isosurface.
class PlacedPieces {
 public:
  PlacedPieces(std::vector<Vec3> points, const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
               int threads)
      : points_(std::move(points)),
        grid_(grid),
        isovalue_(isovalue),
        topology_(topology),
        component_of_(components_of(points_, grid, isovalue, topology, threads)) {}

  [[nodiscard]] AssignmentFaults faults(const MeshTopology& pieces, std::span<const std::uint8_t> is_dropped) const {
    if (!pieces.is_manifold()) return {};
    std::vector<ComponentTopology> topologies;
    topologies.reserve(pieces.components.size());
    for (const MeshComponent& piece : pieces.components) {
      topologies.push_back({piece.euler_characteristic(), piece.boundary_loops});
    }
    return assignment_faults({pieces.component_of_vertex, component_of_, topologies, topology_.components,
                              [this](std::uint32_t v) { return is_doubtful(v); }, is_dropped});
  }

 private:
  // As far from the isosurface as a vertex may be there may be another component.
  [[nodiscard]] bool is_doubtful(std::uint32_t v) const {
    const Vec3& spacing = grid_.spacing();
    const double most = Promise().max_residual * std::min({spacing.x, spacing.y, spacing.z});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double off : {-most, most}) {
        Vec3 p = points_[v];
        p[axis] += off / spacing[axis];
        const auto other = component_of(grid_, isovalue_, topology_, p);
        if (other && *other != component_of_[v]) return true;
      }
    }
    return false;
  }

  std::vector<Vec3> points_;
  const ScalarGrid& grid_;
  double isovalue_;
  const IsosurfaceTopology& topology_;
  std::vector<std::uint32_t> component_of_;
};

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
      if (pieces.is_wanted(c)) faults.without.push_back(c);
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
    if (share.component == counts_for || !pieces.is_wanted(share.component)) continue;
    if (share.vertices < own[share.component].vertices) continue;
    const std::int64_t least = std::max<std::int64_t>(1, own[share.component].vertices);
    if (pieces.is_doubtful && certain_vertices(pieces, share, least) < least) continue;
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
  // Going through all crossings pays for as many points.
  std::optional<ComponentBlocks> blocks;
  if (points.size() >= topology.crossings.size() / kCrossingsPerPoint) blocks.emplace(grid.dims(), topology);
  std::vector<std::uint32_t> components(points.size());
  for_each_block(points.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      auto component = blocks ? blocks->only_component(points[i]) : std::nullopt;
      if (!component) component = component_of(grid, isovalue, topology, points[i]);
      components[i] = component.value_or(kNoComponent);
    }
  });
  return components;
}

AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const MeshTopology& pieces, const ExactSurface& surface) {
  const Vec3& step = surface.isosurface.step();
  std::vector<Vec3> points;
  points.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) points.push_back({p.x / step.x, p.y / step.y, p.z / step.z});
  return PlacedPieces(std::move(points), surface.grid(), surface.isosurface.isovalue(), surface.topology,
                      surface.threads)
      .faults(pieces, surface.is_dropped);
}

AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface) {
  return assignment_faults(mesh, mesh_topology(mesh.points.size(), mesh.triangles, surface.threads), surface);
}

AssignmentFaults assignment_faults(const TriangleMesh& mesh, const MeshTopology& pieces, const ScalarGrid& grid,
                                   double isovalue, const IsosurfaceTopology& topology,
                                   std::span<const std::uint8_t> is_dropped) {
  const Vec3& s = grid.spacing();
  std::vector<Vec3> points;
  points.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) points.push_back(scaled(p - grid.origin(), {1 / s.x, 1 / s.y, 1 / s.z}));
  return PlacedPieces(std::move(points), grid, isovalue, topology, 1).faults(pieces, is_dropped);
}

}  // namespace deliso
