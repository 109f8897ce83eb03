// Where a cubic changes sign within [0, 1], by two methods.
//
// A ray is cut at the faces of the voxel cells, and within each cell the field along it is a cubic in the cell's own
// parameter. It is given in Bernstein form, because its coefficients are plain averages of field values (no
// cancellation) and bound it from both sides.
#pragma once

#include <array>

namespace deliso {

// b[0] (1-t)^3 + 3 b[1] t (1-t)^2 + 3 b[2] t^2 (1-t) + b[3] t^3.
using BernsteinCubic = std::array<double, 4>;
// c[0] + c[1] t + c[2] t^2 + c[3] t^3.
using PowerCubic = std::array<double, 4>;

PowerCubic power_form(const BernsteinCubic& cubic);

// Parameters in [0, 1], ascending, at which a function changes side; zero counts as above. Tangential touches are left
// out. `count` is odd exactly when b[0] and b[3] lie on different sides.
struct SignChanges {
  int count = 0;
  std::array<double, 3> at{};

  void add(double t) { at[static_cast<std::size_t>(count++)] = t; }
};

// Split at the roots of the derivative, then safeguarded Newton on each monotone piece whose ends differ in sign. The
// number of sign changes agrees with the signs at the ends by construction.
SignChanges bracketed_sign_changes(const BernsteinCubic& cubic);

// The paper's solver: the real roots by Schwarze's closed form, of those the ones in [0, 1]. When rounding at an end of
// the interval makes their number disagree with the signs at the ends, the root nearest to an end goes in or out.
SignChanges schwarze_sign_changes(const BernsteinCubic& cubic);

// The real roots of odd multiplicity, ascending, by closed form (Schwarze, Cubic and quartic roots, Graphics Gems,
// 1990), also when the leading coefficients vanish. A constant has none. The closed form loses digits when the cubic is
// nearly a quadratic (rays nearly along an axis; up to 4e-4 of the interval), so two Newton steps follow it.
SignChanges schwarze_roots(const PowerCubic& cubic);

}  // namespace deliso
