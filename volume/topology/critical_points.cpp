#include "volume/topology/critical_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "volume/topology/cell_sweep.h"
#include "volume/topology/exact_signs.h"
#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

// The rounding error of a body saddle's height is below this fraction of the largest difference to the isovalue.
constexpr double kRounding = 1e-11;

bool is_inside(double x) { return x > 0 && x < 1; }

// For the four edges of a cell along each axis: which rise, and which fall. Bit l stands for the edge whose ends have
// the bits of l along the two next axes. The comparisons are exact, and they alone show that most cells have no
// critical point.
struct EdgeSigns {
  explicit EdgeSigns(const CellCorners& corners) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t line = 0; line < 4; ++line) {
        const std::size_t low = ((line & 1u) << (axis + 1) % 3) | ((line >> 1) << (axis + 2) % 3);
        const double change = corners[low | (std::size_t{1} << axis)] - corners[low];
        rises[axis] |= change > 0 ? 1u << line : 0u;
        falls[axis] |= change < 0 ? 1u << line : 0u;
      }
    }
  }
  // Whether edge a rises and edge b falls along the axis, or the other way round.
  [[nodiscard]] bool oppose(std::size_t axis, std::size_t a, std::size_t b) const {
    return (((rises[axis] >> a & falls[axis] >> b) | (falls[axis] >> a & rises[axis] >> b)) & 1u) != 0;
  }
  // Whether some partial derivative has one strict sign in the whole cell: then the four edges along its axis all rise
  // or all fall.
  [[nodiscard]] bool are_monotone() const {
    constexpr unsigned kAll = 0b1111u;
    const auto all = [](unsigned edges) { return edges == kAll; };
    return std::any_of(rises.begin(), rises.end(), all) || std::any_of(falls.begin(), falls.end(), all);
  }

  std::array<unsigned, 3> rises{};
  std::array<unsigned, 3> falls{};
};

// On a face g = f00 + (f10 - f00) x + (f01 - f00) y + k x y has its saddle where both partial derivatives vanish. It
// is inside if and only if opposite edges oppose each other.
void append_face_saddles(const CellCorners& corners, const EdgeSigns& edges, std::vector<CriticalPoint>& points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!edges.oppose(u, 2 * side, 2 * side + 1) || !edges.oppose(v, side, side + 2)) continue;
      const double f00 = corners[side << axis];
      const double f10 = corners[(side << axis) | (1u << u)];
      const double f01 = corners[(side << axis) | (1u << v)];
      const double f11 = corners[(side << axis) | (1u << u) | (1u << v)];
      const double k = f00 - f10 - f01 + f11;
      const double x = (f00 - f01) / k;
      const double y = (f00 - f10) / k;
      if (!is_inside(x) || !is_inside(y)) continue;
      CriticalPoint point;
      point.uvw[axis] = static_cast<double>(side);
      point.uvw[u] = x;
      point.uvw[v] = y;
      point.value = trilinear_value(corners, point.uvw);
      point.face = static_cast<int>(2 * axis + side);
      points.push_back(point);
    }
  }
}

// With g = ... + b x + c y + d z + e xy + f yz + k xz + h xyz and the origin moved to (-f/h, -k/h, -e/h), g has only
// the terms A X + B Y + C Z + h XYZ; its gradient vanishes where YZ = -A/h, XZ = -B/h, XY = -C/h. Without the last term
// the gradient is linear.
void append_body_saddles(const CellCorners& g, std::vector<CriticalPoint>& points) {
  const double b = g[1] - g[0];
  const double c = g[2] - g[0];
  const double d = g[4] - g[0];
  const double e = g[3] - g[1] - c;
  const double f = g[6] - g[4] - c;
  const double k = g[5] - g[4] - b;
  const double h = g[7] - g[6] - g[5] + g[4] - (g[3] - g[2] - g[1] + g[0]);
  const auto append = [&](const Vec3& uvw) {
    if (is_inside(uvw.x) && is_inside(uvw.y) && is_inside(uvw.z)) points.push_back({uvw, trilinear_value(g, uvw), -1});
  };
  if (h == 0) {
    const double half = -0.5 * (b * f + c * k + d * e);
    append({(half + b * f) / (e * k), (half + c * k) / (e * f), (half + d * e) / (f * k)});
    return;
  }
  const double big_a = b - e * k / h;
  const double big_b = c - e * f / h;
  const double big_c = d - f * k / h;
  const double squared_x = -big_b * big_c / (big_a * h);
  if (!(squared_x > 0) || !std::isfinite(squared_x)) return;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * std::sqrt(squared_x);
    append({x - f / h, -big_c / (h * x) - k / h, -big_b / (h * x) - e / h});
  }
}

// A sample is critical when the set of its neighbours above it, or below it, is one of these. A set has bit 2 axis +
// direction for each neighbour along the axes; bit s of this number stands for the set s.
constexpr std::uint64_t kCriticalSets =
    std::uint64_t{1} | std::uint64_t{1} << 0b11u | std::uint64_t{1} << 0b1100u | std::uint64_t{1} << 0b110000u;
constexpr unsigned kAllNeighbours = 0b111111u;

// The critical corners of a cell that has no corner on the border of the grid: those that lie above both their
// neighbours, or below both, along every axis. No branches, because the outcomes are unpredictable.
template <class Samples>
unsigned critical_corners_within(const Samples& samples, std::size_t first, const std::array<std::size_t, 3>& strides) {
  unsigned critical = 0xFFu;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = strides[axis];
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    unsigned alike = 0;  // corners above both neighbours along the axis, or below both
    for (std::size_t line = 0; line < 4; ++line) {
      const std::size_t at = first + (line & 1u) * strides[u] + (line >> 1) * strides[v];
      const std::size_t near = ((line & 1u) << u) | ((line >> 1) << v);
      const auto falls_before = static_cast<unsigned>(samples[at - step] > samples[at]);
      const auto falls = static_cast<unsigned>(samples[at] > samples[at + step]);
      const auto falls_behind = static_cast<unsigned>(samples[at + step] > samples[at + 2 * step]);
      alike |= (falls_before ^ falls) << near | (falls ^ falls_behind) << (near + (std::size_t{1} << axis));
    }
    critical &= alike;
  }
  return critical;
}

}  // namespace

void append_critical_points(const CellCorners& corners, std::vector<CriticalPoint>& points) {
  const EdgeSigns edges(corners);
  append_face_saddles(corners, edges, points);
  if (!edges.are_monotone()) append_body_saddles(corners, points);
}

int side_of_saddle(const CellCorners& corners, double isovalue, const CriticalPoint& saddle) {
  if (saddle.face < 0) {
    double scale = 0;
    for (const double value : corners) scale = std::max(scale, std::abs(value - isovalue));
    const double height = saddle.value - isovalue;
    return std::abs(height) <= kRounding * scale ? 0 : height > 0 ? 1 : -1;
  }
  // On a face the saddle's height is (f0 f2 - f1 f3) / (f0 - f1 + f2 - f3), corners in circular order, less the
  // isovalue.
  const std::array<int, 4> c = face_corners(saddle.face);
  const auto corner = [&](std::size_t i) { return corners[static_cast<std::size_t>(c[i])]; };
  const int determinant = exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    const auto f = [&](std::size_t i) { return Number::difference(corner(i), isovalue); };
    return f(0) * f(2) - f(1) * f(3);
  });
  return (corner(0) - corner(1)) + (corner(2) - corner(3)) > 0 ? determinant : -determinant;
}

unsigned critical_corners(const ScalarGrid& grid, const std::array<std::int32_t, 3>& cell) {
  return visit_samples(grid.samples(), [&](const auto& samples) {
    const std::size_t first = grid.index(cell[0], cell[1], cell[2]);
    const std::array<std::size_t, 3> strides = {1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
    bool is_within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) is_within &= cell[axis] > 0 && cell[axis] + 2 < grid.dims()[axis];
    if (is_within) return critical_corners_within(samples, first, strides);
    // At the border some neighbours are missing, so the sets themselves are compared.
    std::array<unsigned, 8> there;  // the neighbours that exist
    there.fill(kAllNeighbours);
    std::array<unsigned, 8> above{};  // those of them that lie above the corner
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t step = strides[axis];
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const bool has_before = cell[axis] > 0;
      const bool has_behind = cell[axis] + 2 < grid.dims()[axis];
      const unsigned down = 1u << (2 * axis);
      const unsigned up = 2u << (2 * axis);
      // Along each of four lines: a sample before the cell, two corners, a sample behind it.
      for (std::size_t line = 0; line < 4; ++line) {
        const std::size_t at = first + (line & 1u) * strides[u] + (line >> 1) * strides[v];
        const std::size_t near = ((line & 1u) << u) | ((line >> 1) << v);
        const std::size_t far = near | (std::size_t{1} << axis);
        const bool rises = samples[at] <= samples[at + step];
        above[near] |= rises ? up : 0u;
        above[far] |= rises ? 0u : down;
        if (!has_before) there[near] &= ~down;
        if (has_before && samples[at - step] > samples[at]) above[near] |= down;
        if (!has_behind) there[far] &= ~up;
        if (has_behind && samples[at + step] <= samples[at + 2 * step]) above[far] |= up;
      }
    }
    unsigned critical = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const unsigned below = there[corner] & ~above[corner];
      critical |= static_cast<unsigned>((kCriticalSets >> above[corner] | kCriticalSets >> below) & 1u) << corner;
    }
    return critical;
  });
}

}  // namespace deliso
