// Brute force for rays: every lattice plane cuts the line, every piece gets its cubic by interpolation in long double,
// and every root is isolated between the extrema and bisected. Shares no code with raycast/.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "raycast/isosurface.h"

namespace deliso::testing {

class RayOracle {
 public:
  using Real = long double;
  struct Root {
    Real t;
    bool falling;
  };
  struct Answer {
    std::vector<Root> roots;
    bool near_touch = false;  // some extremum or end is within rounding of the isovalue: the count may differ
  };

  RayOracle(const ScalarGrid& grid, double isovalue, const Vec3& step) : grid_(grid), iso_(isovalue) {
    for (std::size_t a = 0; a < 3; ++a) step_[a] = static_cast<Real>(step[a]);
  }

  // The field minus the isovalue at a point of mesh space, extended beyond the box.
  [[nodiscard]] Real value(const std::array<Real, 3>& p) const {
    std::int32_t cell[3];
    Real u[3];
    for (std::size_t a = 0; a < 3; ++a) {
      const Real x = std::clamp(p[a] / step_[a], Real{0}, static_cast<Real>(grid_.dims()[a] - 1));
      cell[a] = std::min(static_cast<std::int32_t>(x), grid_.dims()[a] - 2);
      u[a] = x - cell[a];
    }
    Real sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int i = corner & 1;
      const int j = (corner >> 1) & 1;
      const int k = corner >> 2;
      const Real weight = (i != 0 ? u[0] : 1 - u[0]) * (j != 0 ? u[1] : 1 - u[1]) * (k != 0 ? u[2] : 1 - u[2]);
      sum += weight * (static_cast<Real>(grid_.at(cell[0] + i, cell[1] + j, cell[2] + k)) - iso_);
    }
    return sum;
  }
  [[nodiscard]] Real value_on(const Line& line, Real t) const {
    std::array<Real, 3> p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = line.origin[a] + t * static_cast<Real>(line.direction[a]);
    return value(p);
  }

  [[nodiscard]] Answer roots(const Line& line, double t0, double t1) const {
    // Cut at all lattice planes.
    std::vector<Real> cuts{t0, t1};
    for (std::size_t a = 0; a < 3; ++a) {
      if (line.direction[a] == 0) continue;
      for (std::int32_t plane = 0; plane < grid_.dims()[a]; ++plane) {
        const Real t = (plane * step_[a] - line.origin[a]) / static_cast<Real>(line.direction[a]);
        if (t > t0 && t < t1) cuts.push_back(t);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    Answer answer;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add_piece(line, cuts[i], cuts[i + 1], answer);
    check_ends(line, t0, t1, answer);
    return answer;
  }

 private:
  static constexpr Real kTouch = 1e-9L;  // a value, relative to the data's range, that is too near to call

  [[nodiscard]] bool too_near(Real value) const {
    return std::abs(value) < kTouch * static_cast<Real>(grid_.range().second - grid_.range().first);
  }
  void check_ends(const Line& line, Real t0, Real t1, Answer& answer) const {
    if (too_near(value_on(line, t0)) || too_near(value_on(line, t1))) answer.near_touch = true;
  }

  // Within a piece the field is a cubic: its extrema, from its values at 0, 1/3, 2/3 and 1, then bisection.
  void add_piece(const Line& line, Real from, Real to, Answer& answer) const {
    if (!(to > from)) return;
    const auto at = [&](Real u) { return value_on(line, from + u * (to - from)); };
    const Real f0 = at(0);
    const Real f1 = at(1.0L / 3);
    const Real f2 = at(2.0L / 3);
    const Real f3 = at(1);
    const Real c1 = (-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 2;
    const Real c2 = (18 * f0 - 45 * f1 + 36 * f2 - 9 * f3) / 2;
    const Real c3 = (-9 * f0 + 27 * f1 - 27 * f2 + 9 * f3) / 2;
    std::vector<Real> splits{0};
    const Real scale = std::abs(c1) + std::abs(c2) + std::abs(c3);
    if (std::abs(c3) > 1e-15L * scale) {
      const Real discriminant = c2 * c2 - 3 * c3 * c1;
      if (discriminant > 0)
        for (const Real sign : {-1, 1}) splits.push_back((-c2 + sign * std::sqrt(discriminant)) / (3 * c3));
    }
    if (std::abs(c2) > 0) splits.push_back(-c1 / (2 * c2));  // harmless where it is no extremum
    std::erase_if(splits, [](Real u) { return !(u >= 0 && u < 1); });
    splits.push_back(1);
    std::sort(splits.begin(), splits.end());
    for (std::size_t i = 0; i < splits.size(); ++i)
      if (i > 0 && i + 1 < splits.size() && too_near(at(splits[i]))) answer.near_touch = true;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
      Real low = splits[i];
      Real high = splits[i + 1];
      const bool above_low = at(low) >= 0;
      if (above_low == (at(high) >= 0)) continue;
      for (int step = 0; step < 80; ++step) {
        const Real middle = (low + high) / 2;
        ((at(middle) >= 0) == above_low ? low : high) = middle;
      }
      answer.roots.push_back({from + low * (to - from), above_low});
    }
  }

  const ScalarGrid& grid_;
  Real iso_;
  std::array<Real, 3> step_{};
};

}  // namespace deliso::testing
