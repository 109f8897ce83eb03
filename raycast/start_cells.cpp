#include "raycast/start_cells.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace deliso {

namespace {

template <std::size_t kCount>
struct FindStartCells {
  // A coordinate along an axis whose last sample is `last`: its cell, and its position within the cell.
  struct Along {
    double cell = 0, place = 0;
  };
  [[gnu::always_inline]] static Along along(double coordinate, double last) {
    const double x = coordinate > 0 ? (coordinate < last ? coordinate : last) : 0;
    const double lower = static_cast<std::int32_t>(x);
    const double cell = lower < last - 1 ? lower : last - 1;
    return {cell, x - cell};
  }

  [[gnu::always_inline]] static bool holds(double high, double coordinate) {
    return (coordinate >= 0) & (coordinate <= high);
  }

  [[gnu::always_inline]] static void run(const LineLanes& lines, const double& reach, const GridFrame& frame,
                                         StartCells& cells) {
    const auto [dims, scale, high] = frame;
    const double nx = dims[0], ny = dims[1], nz = dims[2], farthest = reach;
    LineLanes found;
    Lanes first, reaches;  // first: whole numbers, which doubles hold
    for (std::size_t i = 0; i < kCount; ++i) {
      const Vec3 p = lines.origin.at(i), origin = scaled(p, scale);
      const Along x = along(origin.x, nx - 1), y = along(origin.y, ny - 1), z = along(origin.z, nz - 1);
      found.set(i, {{x.place, y.place, z.place}, scaled(lines.direction.at(i), scale)});
      first[i] = x.cell + nx * (y.cell + ny * z.cell);
      const bool in_x = holds(high.x, p.x), in_y = holds(high.y, p.y), in_z = holds(high.z, p.z);
      const bool is_inside = in_x & in_y & in_z;
      reaches[i] = is_inside ? farthest : -1;
    }
    cells.line = found;
    cells.reach = reaches;
    for (std::size_t i = 0; i < kCount; ++i) cells.first[i] = static_cast<std::size_t>(first[i]);
  }
};

// c0 + c1 t + c2 t^2 + c3 t^3.
struct Cubic {
  double c0, c1, c2, c3;
};

// A linear function of t: the values at both ends of an edge, interpolated.
struct Linear {
  double c0, c1;
};

template <std::size_t kCount>
struct FallingHitsAround {
  // The interpolant on the line: interpolated along x, then y, then z, each time by a linear function of t.
  [[gnu::always_inline]] static Linear on_edge(double low, double high, double u, double d) {
    const double rise = high - low;
    return {low + rise * u, rise * d};
  }
  struct Quadratic {
    double c0, c1, c2;
  };
  [[gnu::always_inline]] static Quadratic on_face(const Linear& low, const Linear& high, double u, double d) {
    const double rise0 = high.c0 - low.c0, rise1 = high.c1 - low.c1;
    return {low.c0 + rise0 * u, low.c1 + rise1 * u + rise0 * d, rise1 * d};
  }
  [[gnu::always_inline]] static Cubic on_line(const std::array<Lanes, 8>& f, std::size_t i, const Vec3& u,
                                              const Vec3& d) {
    const Quadratic low = on_face(on_edge(f[0][i], f[1][i], u.x, d.x), on_edge(f[2][i], f[3][i], u.x, d.x), u.y, d.y);
    const Quadratic high = on_face(on_edge(f[4][i], f[5][i], u.x, d.x), on_edge(f[6][i], f[7][i], u.x, d.x), u.y, d.y);
    const double rise0 = high.c0 - low.c0, rise1 = high.c1 - low.c1, rise2 = high.c2 - low.c2;
    return {low.c0 + rise0 * u.z, low.c1 + rise1 * u.z + rise0 * d.z, low.c2 + rise2 * u.z + rise1 * d.z, rise2 * d.z};
  }

  // Whether the line stays within the cell along an axis over the range from -reach to reach.
  [[gnu::always_inline]] static bool stays(double at, double along, double reach) {
    return reach * std::abs(along) <= (1 - at < at ? 1 - at : at);
  }

  [[gnu::always_inline]] static void run(StartCells& cells) {
    constexpr double kLeastSlope = 0.5;  // as a fraction of the slope at t = 0
    constexpr int kMostSteps = 8;
    constexpr double kSmallStep = 1e-8;  // its square is below the rounding of a double
    Lanes c0, c1, c2, c3, t;
    Lanes moves;  // 1 for a lane that still moves
    for (std::size_t i = 0; i < kCount; ++i) {
      const Cubic c = on_line(cells.relative, i, cells.line.origin.at(i), cells.line.direction.at(i));
      c0[i] = c.c0;
      c1[i] = c.c1;
      c2[i] = c.c2;
      c3[i] = c.c3;
      t[i] = -c.c0 / c.c1;
      moves[i] = c.c1 < 0 ? 1 : 0;
    }
    // Newton's method, until no lane moves.
    for (int step = 0; step < kMostSteps; ++step) {
#pragma GCC unroll 1
      for (std::size_t i = 0; i < kCount; ++i) {
        const double slope = (3 * c3[i] * t[i] + 2 * c2[i]) * t[i] + c1[i];
        const double change = (((c3[i] * t[i] + c2[i]) * t[i] + c1[i]) * t[i] + c0[i]) / slope;
        t[i] = moves[i] != 0 ? t[i] - change : t[i];
        moves[i] = std::abs(change) <= kSmallStep ? 0 : moves[i];
      }
      double moving = 0;
      for (std::size_t i = 0; i < kCount; ++i) moving += moves[i];
      if (moving == 0) break;
    }
    for (std::size_t i = 0; i < kCount; ++i) {
      const Vec3 u = cells.line.origin.at(i), d = cells.line.direction.at(i);
      const double reach = std::abs(t[i]);
      const double bend = (2 * std::abs(c2[i]) + 3 * std::abs(c3[i]) * reach) * reach;
      const bool in_x = stays(u.x, d.x, reach), in_y = stays(u.y, d.y, reach), in_z = stays(u.z, d.z, reach);
      const bool falls = c1[i] < 0, rests = moves[i] == 0, is_near = reach <= cells.reach[i],
                 is_straight = bend <= (kLeastSlope - 1) * c1[i];
      const bool is_hit = falls & rests & is_near & is_straight & in_x & in_y & in_z;
      cells.hit[i] = is_hit ? t[i] : std::numeric_limits<double>::quiet_NaN();
    }
  }
};

}  // namespace

void find_start_cells(const LineLanes& lines, double reach, const GridFrame& frame, bool first_alone,
                      StartCells& cells) {
  if (first_alone) return FindStartCells<1>::run(lines, reach, frame, cells);
  run_in_lanes<FindStartCells<kLanes>>(lines, reach, frame, cells);
}

void falling_hits_around(bool first_alone, StartCells& cells) {
  if (first_alone) return FallingHitsAround<1>::run(cells);
  run_in_lanes<FallingHitsAround<kLanes>>(cells);
}

}  // namespace deliso
