// Building a triangulation by parts: most points on two threads, either side of a plane.
//
// First an eighth of the points is triangulated. A plane across the longest axis then halves the other points. Each
// part walks to its points and inserts them in their order. Where the walk or the conflict region would leave the slab,
// the point is left to the whole. The perturbation uses the order of the input, so the insertion order does not matter.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "delaunay/base/parallel.h"
#include "delaunay/bowyer_watson.h"

namespace deliso {

namespace {

// The ratio of tetrahedra to points stays as it was before the parts, plus this margin; unused slots stay free.
constexpr double kMoreTets = 1.02;

// The two sides of a plane that halves the points and contains none of them.
std::array<Slab, 2> halves_of(std::span<const Vec3> points, std::span<const std::uint32_t> order) {
  Box3 box;
  for (const std::uint32_t input : order) box.extend(points[input]);
  const Vec3 size = box.size();
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<double> places;
  places.reserve(order.size());
  for (const std::uint32_t input : order) places.push_back(points[input][axis]);
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end());
  const double below = *middle;
  double above = box.high[axis];
  std::for_each(middle, places.end(), [&](double place) {
    if (place > below) above = std::min(above, place);
  });
  std::array<Slab, 2> halves{};
  halves[0].axis = halves[1].axis = axis;
  halves[0].high = halves[1].low = 0.5 * below + 0.5 * above;
  return halves;
}

// The latest vertex in each cell of a grid.
class LatestVertices {
 public:
  explicit LatestVertices(const Box3& box) : low_(box.low) {
    const Vec3 size = box.size();
    for (std::size_t axis = 0; axis < 3; ++axis) cells_per_unit_[axis] = size[axis] > 0 ? kCells / size[axis] : 0;
  }
  [[nodiscard]] VertexId& at(const Vec3& p) {
    std::size_t cell = 0;
    for (const std::size_t axis : {2u, 1u, 0u}) {
      const double place = (p[axis] - low_[axis]) * cells_per_unit_[axis];
      cell = kCells * cell + static_cast<std::size_t>(std::clamp(place, 0.0, kCells - 1.0));
    }
    return latest_[cell];
  }

 private:
  static constexpr std::size_t kCells = 32;  // along each axis

  Vec3 low_, cells_per_unit_;
  std::vector<VertexId> latest_ = std::vector<VertexId>(kCells * kCells * kCells);
};

}  // namespace

void BowyerWatson::insert_in_slabs(const Insertions& some, int threads) {
  const std::array<Slab, 2> slabs = halves_of(some.points, some.order);
  const auto count_in = [&](const Slab& slab) {
    return static_cast<std::size_t>(std::count_if(
        some.order.begin(), some.order.end(), [&](std::uint32_t input) { return slab.contains(some.points[input]); }));
  };
  const std::size_t most = std::max(count_in(slabs[0]), count_in(slabs[1])), before = vertex_count();
  const double tets_per_point = static_cast<double>(tets_.size()) / static_cast<double>(before);
  std::vector<std::unique_ptr<BowyerWatson>> parts;
  for (const PartRoom& room : make_rooms(slabs, most + 1, threads, kMoreTets * tets_per_point)) {
    parts.push_back(std::make_unique<BowyerWatson>(*this, room));
  }
  run_tasks(parts.size(), threads, [&](std::size_t k) { parts[k]->insert_within(some, before); });
  for (const auto& part : parts) join(*part);
  insert_in_order(some);
}

void BowyerWatson::insert_within(const Insertions& some, std::size_t before) {
  LatestVertices latest(box_);
  for (std::size_t v = 0; v < before; ++v) {
    if (slab_->contains(points_[v])) latest.at(points_[v]) = VertexId(v);
  }
  TetId hint;
  // The latest point left to the whole; points equal to it are left, too, see insert_in_order().
  std::optional<Vec3> left;
  for (std::size_t i = 0; i < some.order.size(); ++i) {
    const Vec3& p = some.points[some.order[i]];
    if (!slab_->contains(p) || left == p) continue;
    VertexId& near = latest.at(p);
    TetId located = locate_within(p, hint);
    if (located.is_none() && !near.is_none()) located = locate_within(p, incident_tet(near));
    is_blocked_ = located.is_none();
    std::optional<VertexId> duplicate;
    if (!is_blocked_) duplicate = find_conflicts_from_located(p, VertexId(some.order[i]), located);
    if (duplicate) {
      some.vertices[i] = *duplicate;
    } else if (is_blocked_) {
      left = p;
    } else {
      near = some.vertices[i] = add_vertex(some.order[i], p);
      star_rim(near);
      hint = *std::find_if(created_.begin(), created_.end(), [this](TetId t) { return !is_ghost(t); });
    }
  }
}

// Of a part. Nothing where the walk would leave the slab, or has no tetrahedron to begin at.
TetId BowyerWatson::locate_within(const Vec3& p, TetId hint) const {
  if (hint.is_none() || is_ghost(hint) || !lies_within(*slab_, hint)) return {};
  return visibility_walk_within(*this, filter_, *slab_, p, hint);
}

}  // namespace deliso
