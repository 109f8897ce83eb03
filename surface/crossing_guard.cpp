#include "surface/crossing_guard.h"

#include <algorithm>
#include <cmath>

#include "surface/self_intersection.h"

namespace deliso {

namespace {

// Vertices nearer than this (mesh-space units) lie on top of each other.
constexpr double kOnTop = 2e-3;
// No clearance is trusted at the corners of a triangle whose box is this near to a suspect (mesh-space units).
constexpr double kSuspectReach = 3;
// A triangle is tight when its clearance is below so many of its longest edge.
constexpr double kTightness = 1.5;
// Other sheets matter when the clearance is below so many times what the mesh moves.
constexpr double kReach = 20;
// Cells are numbered up to this far from the origin; beyond it they run together.
constexpr double kFarthest = 1e9;
constexpr double kFarthestPlace = 1e18;  // the same for the cells of doubled vertices
constexpr double kManyCells = 4096;

struct CellHash {
  std::size_t operator()(const std::array<std::int64_t, 3>& c) const {
    const auto mix = [](std::uint64_t h, std::int64_t x) {
      return (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    };
    return mix(mix(mix(0, c[0]), c[1]), c[2]) >> 7;
  }
};

// Vertices with another one on top of them, found in a grid of cells just as large.
std::vector<std::uint32_t> doubled_vertices(const std::vector<Vec3>& points) {
  const auto cell_of = [](const Vec3& p, int dx, int dy, int dz) {
    const auto place = [](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x / kOnTop), -kFarthestPlace, kFarthestPlace));
    };
    return std::array<std::int64_t, 3>{place(p.x) + dx, place(p.y) + dy, place(p.z) + dz};
  };
  std::unordered_map<std::array<std::int64_t, 3>, std::vector<std::uint32_t>, CellHash> cells;
  cells.reserve(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) cells[cell_of(points[v], 0, 0, 0)].push_back(v);
  std::vector<std::uint32_t> doubled;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    bool found = false;
    for (int i = 0; i < 27 && !found; ++i) {
      const auto at = cells.find(cell_of(points[v], i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
      if (at == cells.end()) continue;
      found = std::any_of(at->second.begin(), at->second.end(), [&](std::uint32_t w) {
        return w != v && squared_distance(points[v], points[w]) < kOnTop * kOnTop;
      });
    }
    if (found) doubled.push_back(v);
  }
  return doubled;
}

}  // namespace

CrossingGuard::CrossingGuard(SurfaceMesh& mesh, std::span<const Vec3> suspects) : mesh_(mesh) {
  clearance_.assign(mesh.pole_heights.begin(), mesh.pole_heights.end());
  std::vector<std::uint32_t> reached = doubled_vertices(mesh.points);
  for (std::uint32_t t = 0; t < mesh.triangles.size() && !suspects.empty(); ++t) {
    const Box3 box = box_of(mesh.triangles[t]);
    if (std::any_of(suspects.begin(), suspects.end(),
                    [&](const Vec3& p) { return squared_distance(p, box.clamp(p)) < kSuspectReach * kSuspectReach; })) {
      reached.insert(reached.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    }
  }
  for (const std::uint32_t v : reached) clearance_[v] = 0;
  // The bound falls off by distance along edges.
  std::vector<std::vector<std::uint32_t>> around;
  if (!reached.empty()) {
    around.resize(mesh.points.size());
    for (const auto& t : mesh.triangles) {
      for (unsigned i = 0; i < 3; ++i) around[t[i]].push_back(t[(i + 1) % 3]);
    }
  }
  for (std::size_t at = 0; at < reached.size(); ++at) {
    const std::uint32_t v = reached[at];
    for (const std::uint32_t w : around[v]) {
      const float bound = clearance_[v] + static_cast<float>(distance(mesh.points[v], mesh.points[w]));
      if (bound >= clearance_[w]) continue;
      clearance_[w] = bound;
      reached.push_back(w);
    }
  }
  is_kept_.assign(mesh.triangles.size(), false);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) learn(t);
}

bool CrossingGuard::is_tight(const Corners& v) const {
  double longest = 0;
  float clearance = clearance_[v[0]];
  for (unsigned i = 0; i < 3; ++i) {
    longest = std::max(longest, squared_distance(mesh_.points[v[i]], mesh_.points[v[(i + 1) % 3]]));
    clearance = std::min(clearance, clearance_[v[i]]);
  }
  return clearance * clearance < kTightness * kTightness * longest;
}

Box3 CrossingGuard::box_of(const Corners& v) const {
  Box3 box;
  for (const std::uint32_t q : v) box.extend(mesh_.points[q]);
  return box;
}

int CrossingGuard::level_of(const Box3& box) {
  const Vec3 size = box.size();
  return std::ilogb(std::max({size.x, size.y, size.z, 0.5})) + 1;
}

std::uint64_t CrossingGuard::key(const Cell& cell) {
  std::uint64_t key = static_cast<std::uint64_t>(cell.level);
  for (const std::int32_t x : cell.at) key = key << 19 | (static_cast<std::uint64_t>(x) & 0x7FFFFu);
  return key;
}

// The cells of a level that a box meets; when they are very many, those that hold something instead.
template <class Visit>
void CrossingGuard::for_each_cell(const Box3& box, int level, Visit&& visit) const {
  double count = 1;
  Cell low{level, {}};
  Cell high{level, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = [&](double x) {
      return static_cast<std::int32_t>(std::clamp(std::floor(std::ldexp(x, -level)), -kFarthest, kFarthest));
    };
    low.at[axis] = place(box.low[axis]);
    high.at[axis] = place(box.high[axis]);
    count *= high.at[axis] - low.at[axis] + 1.0;
  }
  if (count > kManyCells) {
    for (const auto& [at, ignored] : cells_) {
      if (at >> 57 == static_cast<std::uint64_t>(level)) visit(at);
    }
    return;
  }
  Cell cell{level, {}};
  for (cell.at[2] = low.at[2]; cell.at[2] <= high.at[2]; ++cell.at[2]) {
    for (cell.at[1] = low.at[1]; cell.at[1] <= high.at[1]; ++cell.at[1]) {
      for (cell.at[0] = low.at[0]; cell.at[0] <= high.at[0]; ++cell.at[0]) visit(key(cell));
    }
  }
}

void CrossingGuard::learn(std::uint32_t triangle) {
  if (is_kept_.size() <= triangle) is_kept_.resize(triangle + 1, false);
  const Corners& v = mesh_.triangles[triangle];
  if (!is_tight(v)) return;
  const Box3 box = box_of(v);
  const int level = level_of(box);
  if (level >= kLevels) return;  // on a volume stretched that far the check after stage 2 must do
  is_kept_[triangle] = true;
  ++kept_at_[static_cast<std::size_t>(level)];
  for_each_cell(box, level, [&](std::uint64_t at) { cells_[at].push_back(triangle); });
}

void CrossingGuard::forget(std::uint32_t triangle) {
  if (!is_kept_[triangle]) return;
  const Box3 box = box_of(mesh_.triangles[triangle]);
  const int level = level_of(box);
  is_kept_[triangle] = false;
  --kept_at_[static_cast<std::size_t>(level)];
  for_each_cell(box, level, [&](std::uint64_t at) {
    auto& here = cells_[at];
    *std::find(here.begin(), here.end(), triangle) = here.back();
    here.pop_back();
  });
}

bool CrossingGuard::meets(const Corners& v, const Box3& box, const Corners& w) const {
  const Vec3 &a = mesh_.points[w[0]], &b = mesh_.points[w[1]], &c = mesh_.points[w[2]];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::min({a[axis], b[axis], c[axis]}) > box.high[axis]) return false;
    if (std::max({a[axis], b[axis], c[axis]}) < box.low[axis]) return false;
  }
  return has_area(a, b, c) && triangle_contact(mesh_.points, v, w) != TriangleContact::kNone;
}

bool CrossingGuard::crosses(const Vec3& p, double moved, std::span<const Edge> rim, std::span<const std::uint32_t> disk,
                            std::uint32_t attempt) {
  new_clearance_ = static_cast<float>(distance(p, mesh_.points[rim.front()[0]])) + clearance_[rim.front()[0]];
  float mean = 0;
  float least = new_clearance_;
  for (const auto& [from, to] : rim) {
    least = std::min(least, clearance_[from]);
    mean += clearance_[from] / static_cast<float>(rim.size());
    new_clearance_ = std::min(new_clearance_, clearance_[from] + static_cast<float>(distance(p, mesh_.points[from])));
  }
  new_clearance_ = std::min(new_clearance_, mean);
  if (least > kReach * moved) return false;

  // The new vertex joins the mesh for as long as the tests last.
  const auto newest = static_cast<std::uint32_t>(mesh_.points.size());
  mesh_.points.push_back(p);
  clearance_.push_back(new_clearance_);
  const auto star_triangle = [&](const Edge& edge) { return Corners{newest, edge[0], edge[1]}; };
  const auto is_clear = [&](std::size_t i) {
    const Corners v = star_triangle(rim[i]);
    if (!is_tight(v)) return true;
    if (!has_area(p, mesh_.points[v[1]], mesh_.points[v[2]])) return false;
    const Box3 box = box_of(v);
    for (std::size_t j = 0; j < rim.size(); ++j) {
      if (j != i && meets(v, box, star_triangle(rim[j]))) return false;
    }
    bool clear = true;
    for (int level = 0; level < kLevels && clear; ++level) {
      if (kept_at_[static_cast<std::size_t>(level)] == 0) continue;
      for_each_cell(box, level, [&](std::uint64_t at) {
        const auto here = cells_.find(at);
        if (here == cells_.end()) return;
        for (const std::uint32_t t : here->second) {
          if (clear && disk[t] != attempt && meets(v, box, mesh_.triangles[t])) clear = false;
        }
      });
    }
    return clear;
  };
  bool clear = true;
  for (std::size_t i = 0; i < rim.size() && clear; ++i) clear = is_clear(i);
  mesh_.points.pop_back();
  clearance_.pop_back();
  return !clear;
}

}  // namespace deliso
