#include "surface/refine/guard/refinement_crossings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// Gives a mesh of triangles, whose corners are vertices of `from`, the points of these.
void take_points(const RefinementMesh& from, TriangleMesh& mesh) {
  constexpr std::uint32_t kUnseen = 0xFFFFFFFFU;
  std::vector<std::uint32_t> numbers(from.vertices.size(), kUnseen);
  for (auto& corners : mesh.triangles) {
    for (std::uint32_t& v : corners) {
      if (numbers[v] == kUnseen) {
        numbers[v] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(from.vertices[v].point);
      }
      v = numbers[v];
    }
  }
}

// A coarse grid over a box. Points beyond the box count with the first or the last cell of an axis.
class CoarseGrid {
 public:
  static constexpr std::array<unsigned, 3> kCells = {64, 256, 256};  // along each axis
  struct Cell {
    std::array<std::uint8_t, 3> at{};
  };
  // The range of cells that a box meets.
  struct Cells {
    std::array<unsigned, 3> low{}, high{};
  };

  explicit CoarseGrid(const Box3& box) : low_(box.low) {
    const Vec3 size = box.size();
    for (std::size_t k = 0; k < 3; ++k) cells_per_unit_[k] = size[k] > 1e-290 ? (kCells[k] - 2) / size[k] : 0;
  }
  [[nodiscard]] Cell cell(const Vec3& p) const { return {{step(p.x, 0), step(p.y, 1), step(p.z, 2)}}; }
  // Rounding keeps the order of numbers: boxes that have a point in common have a cell in common.
  [[nodiscard]] static Cells around(const Cell& a, const Cell& b, const Cell& c) {
    Cells cells;
    for (std::size_t k = 0; k < 3; ++k) {
      cells.low[k] = std::min(std::min(a.at[k], b.at[k]), c.at[k]);
      cells.high[k] = std::max(std::max(a.at[k], b.at[k]), c.at[k]);
    }
    return cells;
  }

 private:
  [[nodiscard]] std::uint8_t step(double x, std::size_t axis) const {
    const double at = (x - low_[axis]) * cells_per_unit_[axis] + 1;
    return static_cast<std::uint8_t>(std::min(std::max(at, 0.0), kCells[axis] - 1.0));
  }

  Vec3 low_, cells_per_unit_;
};

// Cells of a coarse grid, as rows of bits along x.
class CellMarks {
 public:
  using Cells = CoarseGrid::Cells;

  void add(const Cells& cells) {
    for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
      for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) {
        rows_[CoarseGrid::kCells[1] * z + y] |= row(cells);
        bundles_[bundle(y, z)] |= row(cells);
      }
    }
  }
  [[nodiscard]] bool has_any_of(const Cells& cells) const {
    const std::uint64_t bits = row(cells);
    if ((in_bundles(cells) & bits) == 0) return false;
    for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
      for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) {
        if ((rows_[CoarseGrid::kCells[1] * z + y] & bits) != 0) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kSide = 8;  // in rows; most boxes meet at most two bundles along either axis
  static constexpr std::size_t kBundles = CoarseGrid::kCells[1] / kSide;
  static_assert(CoarseGrid::kCells[1] == CoarseGrid::kCells[2]);

  static std::size_t bundle(std::size_t y, std::size_t z) { return kBundles * (z / kSide) + y / kSide; }
  // A word with the bits low[0] to high[0] set.
  static std::uint64_t row(const Cells& cells) {
    return ~std::uint64_t{0} >> (CoarseGrid::kCells[0] - 1 - cells.high[0] + cells.low[0]) << cells.low[0];
  }
  // The marks in the bundles that the cells meet; all bits if these bundles are many.
  [[nodiscard]] std::uint64_t in_bundles(const Cells& cells) const {
    if (cells.high[1] - cells.low[1] > kSide || cells.high[2] - cells.low[2] > kSide) return ~std::uint64_t{0};
    return bundles_[bundle(cells.low[1], cells.low[2])] | bundles_[bundle(cells.high[1], cells.low[2])] |
           bundles_[bundle(cells.low[1], cells.high[2])] | bundles_[bundle(cells.high[1], cells.high[2])];
  }

  std::vector<std::uint64_t> rows_ = std::vector<std::uint64_t>(kBundles * kSide * kBundles * kSide);
  std::vector<std::uint64_t> bundles_ = std::vector<std::uint64_t>(kBundles * kBundles);
};

using Places = std::vector<std::uint32_t>;

// The triangles that share a grid cell with a renewed triangle: all triangles that meet a renewed one are among them.
Places near_renewed(const RefinementMesh& mesh, int threads) {
  const std::size_t count = mesh.triangles.size();
  const Places renewed = collect_in_blocks<std::uint32_t>(count, threads, [&](std::size_t t, Places& found) {
    if (mesh.triangles[t].is_renewed()) found.push_back(static_cast<std::uint32_t>(t));
  });
  if (renewed.empty()) return {};
  Box3 all;
  for (const std::uint32_t t : renewed) {
    for (const std::uint32_t v : mesh.triangles[t].corners) all.extend(mesh.vertices[v].point);
  }
  const CoarseGrid grid(all);
  std::vector<CoarseGrid::Cell> cells(mesh.vertices.size());  // of each vertex
  for_each_block(cells.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) cells[v] = grid.cell(mesh.vertices[v].point);
  });
  const auto cells_of = [&](const RefinementMesh::Triangle& t) {
    return CoarseGrid::around(cells[t.corners[0]], cells[t.corners[1]], cells[t.corners[2]]);
  };
  CellMarks marks;
  for (const std::uint32_t t : renewed) marks.add(cells_of(mesh.triangles[t]));
  return collect_in_blocks<std::uint32_t>(count, threads, [&](std::size_t t, Places& found) {
    if (marks.has_any_of(cells_of(mesh.triangles[t]))) found.push_back(static_cast<std::uint32_t>(t));
  });
}

}  // namespace

SelfIntersections meeting_pairs(const RefinementMesh& mesh, int threads) {
  TriangleMesh taken;
  taken.points.reserve(mesh.vertices.size());
  taken.triangles.reserve(mesh.triangles.size());
  for (const RefinementMesh::Vertex& v : mesh.vertices) taken.points.push_back(v.point);
  for (const RefinementMesh::Triangle& t : mesh.triangles) taken.triangles.push_back(t.corners);
  return self_intersections_of({}, std::move(taken), kMostMeetingPairs, threads);
}

SelfIntersections meeting_pairs_of_renewed(const RefinementMesh& mesh, int threads) {
  const Places near = near_renewed(mesh, threads);
  if (near.empty()) return {};
  TriangleMesh taken;
  std::vector<std::uint8_t> is_renewed;
  taken.triangles.reserve(near.size());
  is_renewed.reserve(near.size());
  for (const std::uint32_t t : near) {
    taken.triangles.push_back(mesh.triangles[t].corners);
    is_renewed.push_back(mesh.triangles[t].is_renewed() ? 1 : 0);
  }
  take_points(mesh, taken);
  return self_intersections_of(is_renewed, std::move(taken), kMostMeetingPairs, threads);
}

}  // namespace deliso
