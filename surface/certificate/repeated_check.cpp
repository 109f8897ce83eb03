#include "surface/certificate/repeated_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// A check of the whole mesh is no slower where more than this fraction of its triangles is new or gone.
constexpr double kMostChanged = 0.4;

std::array<Vec3, 3> corners_of(const SurfaceMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

// Equal for equal corners in the same order.
std::uint64_t hash_of(const std::array<Vec3, 3>& corners) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const Vec3& p : corners) {
    for (const double x : {p.x, p.y, p.z}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
  }
  return hash;
}

// Finds triangles by their corners: a table with open addresses.
class TrianglesByCorners {
 public:
  explicit TrianglesByCorners(std::size_t most) : table_(std::bit_ceil(2 * most + 2), kFree) {}

  void add(std::uint32_t triangle, const std::array<Vec3, 3>& corners) {
    std::size_t slot = hash_of(corners) & (table_.size() - 1);
    while (table_[slot] != kFree) slot = (slot + 1) & (table_.size() - 1);
    table_[slot] = triangle;
  }
  // Calls visit(triangle) for all whose hashes may be those of the corners.
  template <class Visit>
  void for_each_candidate(const std::array<Vec3, 3>& corners, const Visit& visit) const {
    for (std::size_t slot = hash_of(corners) & (table_.size() - 1); table_[slot] != kFree;
         slot = (slot + 1) & (table_.size() - 1)) {
      visit(table_[slot]);
    }
  }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;
  std::vector<std::uint32_t> table_;
};

// Appends the crossings in a box of mesh space.
void append_crossings_in(const Box3& box, const ExactSurface& surface, std::vector<std::uint32_t>& found) {
  const CrossingIndex& index = surface.topology.index;
  const Vec3& step = surface.isosurface.step();
  CellIndex low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A crossing belongs to the sample below it, up to a step away.
    const double last = index.dims()[axis] - 1.0;
    low[axis] = static_cast<std::int32_t>(std::clamp(std::floor(box.low[axis] / step[axis]) - 1, 0.0, last));
    high[axis] = static_cast<std::int32_t>(std::clamp(std::ceil(box.high[axis] / step[axis]), 0.0, last));
  }
  constexpr std::int32_t kBits = CrossingIndex::kWordBits;
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t w = low[0] / kBits; w <= high[0] / kBits; ++w) {
        const auto crossed = index.crossed(w, j, k);
        for (int axis = 0; axis < 3; ++axis) {
          for (std::uint64_t bits = crossed[static_cast<std::size_t>(axis)]; bits != 0; bits &= bits - 1) {
            const std::int32_t i = w * kBits + std::countr_zero(bits);
            if (low[0] <= i && i <= high[0]) found.push_back(index.number(i, j, k, axis));
          }
        }
      }
    }
  }
}

void sort_and_unite(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// The crossings as near as that to some triangles along each axis, ascending.
std::vector<std::uint32_t> crossings_around(std::span<const std::array<Vec3, 3>> triangles, const Vec3& reach,
                                            const ExactSurface& surface) {
  std::vector<std::uint32_t> found;
  for (const std::array<Vec3, 3>& corners : triangles) {
    Box3 box;
    for (const Vec3& p : corners) box.extend(p);
    append_crossings_in({box.low - reach, box.high + reach}, surface, found);
    // Neighbours have the same crossings around them.
    constexpr std::size_t kTooMany = 1 << 22;
    if (found.size() > kTooMany) sort_and_unite(found);
  }
  sort_and_unite(found);
  return found;
}

// Those of some cells, ascending, that are as near as that to some triangles along each axis.
std::vector<std::uint64_t> cells_around(std::span<const std::array<Vec3, 3>> triangles, const Vec3& reach,
                                        const ExactSurface& surface, std::span<const std::uint64_t> cells) {
  constexpr double kRounding = 1e-6;
  const Dims& dims = surface.grid().dims();
  const Vec3& step = surface.isosurface.step();
  std::vector<std::uint64_t> found;
  for (const std::array<Vec3, 3>& corners : triangles) {
    Box3 box;
    for (const Vec3& p : corners) box.extend(p);
    CellIndex low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell = [&](double place) {
        return static_cast<std::int32_t>(std::clamp(std::floor(place), 0.0, dims.at(axis) - 2.0));
      };
      low[axis] = cell((box.low[axis] - reach[axis]) / step[axis] - kRounding);
      high[axis] = cell((box.high[axis] + reach[axis]) / step[axis] + kRounding);
    }
    for (std::int32_t k = low[2]; k <= high[2]; ++k) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        const std::uint64_t first = surface.grid().index(low[0], j, k), last = surface.grid().index(high[0], j, k);
        const auto begin = std::lower_bound(cells.begin(), cells.end(), first);
        found.insert(found.end(), begin, std::upper_bound(begin, cells.end(), last));
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

GeometryCheck RepeatedCheck::checked(const SurfaceMesh& mesh, decltype(check_geometry)& kind) {
  const std::optional<KnownBefore> known = known_of(mesh);
  GeometryCheck check = kind(mesh, surface_, promise_, known ? &*known : nullptr);
  // Where nothing is off at first, no other check follows.
  if (!has_checked_ && check.is_near()) return check;
  if (!has_checked_ && promise_.within_cells) crossed_cells_ = crossed_cells(surface_);
  has_checked_ = true;
  last_.points = mesh.points;
  last_.triangles = mesh.triangles;
  far_parts_.assign(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < check.far_triangles.size(); ++i) {
    far_parts_[check.far_triangles[i]] = static_cast<std::int32_t>(check.far_parts[i]);
  }
  missed_ = check.missed_numbers;
  missed_places_ = check.missed_places;
  return check;
}

GeometryCheck RepeatedCheck::again_within(const Promise& promise, const SurfaceMesh& mesh) const {
  KnownBefore known;
  if (!has_checked_) return check_geometry(mesh, surface_, promise);
  known.asked = missed_;
  for (const MissedPlace& missed : missed_places_) known.asked_cells.push_back(missed.cell);
  known.far_parts.reserve(far_parts_.size());
  for (const std::int32_t parts : far_parts_) known.far_parts.push_back(parts > 0 ? -1 : 0);
  return check_geometry(mesh, surface_, promise, &known);
}

// Nothing where too little is known.
std::optional<KnownBefore> RepeatedCheck::known_of(const SurfaceMesh& mesh) const {
  if (!has_checked_) return std::nullopt;
  std::vector<bool> stays(last_.triangles.size(), false);
  KnownBefore known;
  known.far_parts.assign(mesh.triangles.size(), -1);
  // Most keep their order: what is gone makes the numbers of later ones smaller.
  constexpr std::size_t kMostGone = 8;  // in a row
  std::size_t next = 0;                 // of the mesh before
  for (std::size_t t = 0; t < mesh.triangles.size() && next < stays.size(); ++t, ++next) {
    const std::array<Vec3, 3> corners = corners_of(mesh, t);
    const std::size_t last = std::min(next + kMostGone, stays.size());
    std::size_t same = next;
    while (same < last && corners_of(last_, same) != corners) ++same;
    if (same == last) continue;
    next = same;
    stays[next] = true;
    known.far_parts[t] = far_parts_[next];
  }
  const auto others = static_cast<std::size_t>(std::count(stays.begin(), stays.end(), false));
  TrianglesByCorners before(others);
  for (std::uint32_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) before.add(t, corners_of(last_, t));
  }
  std::vector<std::array<Vec3, 3>> changed;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (known.far_parts[t] >= 0) continue;
    const std::array<Vec3, 3> corners = corners_of(mesh, t);
    before.for_each_candidate(corners, [&](std::uint32_t old) {
      if (corners_of(last_, old) != corners) return;
      stays[old] = true;
      known.far_parts[t] = far_parts_[old];
    });
    if (known.far_parts[t] < 0) changed.push_back(corners);
  }
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) changed.push_back(corners_of(last_, t));
  }
  if (static_cast<double>(changed.size()) > kMostChanged * static_cast<double>(stays.size())) return std::nullopt;
  const Vec3 reach = promise_.max_distance * Vec3{1, 1, 1};
  known.asked = crossings_around(changed, reach, surface_);
  std::set_difference(missed_.begin(), missed_.end(), known.asked.begin(), known.asked.end(),
                      std::back_inserter(known.missed));
  if (promise_.within_cells) {
    known.asked_cells = cells_around(changed, reach, surface_, crossed_cells_);
    std::copy_if(missed_places_.begin(), missed_places_.end(), std::back_inserter(known.missed_places),
                 [&](const MissedPlace& missed) {
                   return !std::binary_search(known.asked_cells.begin(), known.asked_cells.end(), missed.cell);
                 });
  }
  return known;
}

}  // namespace deliso
