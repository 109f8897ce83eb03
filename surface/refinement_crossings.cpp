#include "surface/refinement_crossings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/blocks.h"

namespace deliso {

namespace {

constexpr std::size_t kAhead = 16;  // triangles: their first corner is the newest, far from those of the others

// Gives triangles whose corners are vertices of `from` the points of these.
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

// The cells of a coarse grid that boxes reach into, as rows of bits along x.
class CellMarks {
 public:
  // Of a grid over a box.
  explicit CellMarks(const Box3& all) : all_(all), rows_(std::size_t{kCells[1]} * kCells[2]) {
    const Vec3 size = all.size();
    for (std::size_t k = 0; k < 3; ++k) cells_per_unit_[k] = size[k] > 1e-290 ? kCells[k] / size[k] : 0;
  }
  void add(const Box3& box) {
    const Cells cells = cells_of(box);
    for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
      for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) rows_[kCells[1] * z + y] |= cells.row();
    }
  }
  // Certain only when false: no box that was added has a point in common with this one.
  [[nodiscard]] bool reached_by(const Box3& box) const {
    if (!all_.meets(box)) return false;
    const Cells cells = cells_of(box);
    for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
      for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) {
        if ((rows_[kCells[1] * z + y] & cells.row()) != 0) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::array<unsigned, 3> kCells = {64, 256, 256};  // along each axis
  struct Cells {
    std::array<unsigned, 3> low{}, high{};
    // The bits low[0] to high[0].
    [[nodiscard]] std::uint64_t row() const {
      return ~std::uint64_t{0} >> (kCells[0] - 1 - high[0] + low[0]) << low[0];
    }
  };
  // Rounding keeps the order of numbers: boxes that have a point in common have a cell in common.
  [[nodiscard]] Cells cells_of(const Box3& box) const {
    Cells cells;
    for (std::size_t k = 0; k < 3; ++k) {
      cells.low[k] = cell(box.low[k], k);
      cells.high[k] = cell(box.high[k], k);
    }
    return cells;
  }
  [[nodiscard]] unsigned cell(double x, std::size_t axis) const {
    const double at = (x - all_.low[axis]) * cells_per_unit_[axis];
    return at > 0 ? static_cast<unsigned>(std::min(at, kCells[axis] - 1.0)) : 0;
  }

  Box3 all_;
  Vec3 cells_per_unit_;
  std::vector<std::uint64_t> rows_;
};

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
  using Places = std::vector<std::uint32_t>;
  const std::size_t count = mesh.triangles.size();
  const Places renewed = collect_in_blocks<std::uint32_t>(count, threads, [&](std::size_t t, Places& found) {
    if (mesh.triangles[t].is_renewed()) found.push_back(static_cast<std::uint32_t>(t));
  });
  if (renewed.empty()) return {};
  Box3 all;
  for (const std::uint32_t t : renewed) {
    for (const std::uint32_t v : mesh.triangles[t].corners) all.extend(mesh.vertices[v].point);
  }
  CellMarks marks(all);
  for (const std::uint32_t t : renewed) marks.add(mesh.box_of(t));

  // Whatever meets a renewed triangle reaches into a cell that one of them reaches into.
  const Places near = collect_in_blocks<std::uint32_t>(count, threads, [&](std::size_t t, Places& found) {
    if (t + kAhead < count) __builtin_prefetch(&mesh.vertices[mesh.triangles[t + kAhead].corners[0]]);
    const auto triangle = static_cast<std::uint32_t>(t);
    if (marks.reached_by(mesh.box_of(triangle))) found.push_back(triangle);
  });
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
