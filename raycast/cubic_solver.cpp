#include "raycast/cubic_solver.h"

#include <algorithm>
#include <cmath>

namespace deliso {

namespace {

constexpr double kPi = 3.14159265358979323846;

bool is_above(double value) { return value >= 0; }

double evaluate(const PowerCubic& c, double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

double derivative(const PowerCubic& c, double t) { return c[1] + t * (2 * c[2] + t * (3 * c[3])); }

void sort_roots(SignChanges& roots) {
  auto& t = roots.at;
  if (roots.count >= 2 && t[0] > t[1]) std::swap(t[0], t[1]);
  if (roots.count < 3) return;
  if (t[1] > t[2]) std::swap(t[1], t[2]);
  if (t[0] > t[1]) std::swap(t[0], t[1]);
}

// The root of a cubic between low and high, where its values differ in sign and it is monotone (or changes sign once).
//
// Each step evaluates the cubic at t and inverts its Taylor series there to fourth order: with n = f / f',
// h = f'' / (2 f'), k = f''' / (6 f') the root is t - n - h n^2 - (2 h^2 - k) n^3 - (5 h^3 - 5 h k) n^4 - O(n^5). Two
// steps are enough as a rule. A step that leaves the bracket becomes a bisection, and so does every third one.
double root_between(const PowerCubic& c, double low, double high, double value_low, double value_high) {
  constexpr double kAccuracy = 1e-17;
  constexpr int kMaxSteps = 200;
  const bool above_low = is_above(value_low);
  double t = low + (high - low) * (value_low / (value_low - value_high));
  if (!(t >= low && t <= high)) t = 0.5 * (low + high);
  for (int i = 1; i < kMaxSteps; ++i) {
    // Shrink the bracket by the sign at t.
    const double value = evaluate(c, t);
    (is_above(value) == above_low ? low : high) = t;
    const double inverse = 1 / derivative(c, t);
    const double n = value * inverse;
    const double h = (c[2] + 3 * c[3] * t) * inverse;
    const double k = c[3] * inverse;
    const double hn = h * n;
    const double kn2 = k * n * n;
    const double next = t - n * (1 + hn * (1 + 2 * hn + 5 * (hn * hn - kn2)) - kn2);
    const double error = 16 * std::abs(n) * (hn * hn * hn * hn + kn2 * kn2);
    if (next >= low && next <= high && (error <= kAccuracy || i % 3 != 0)) {
      if (error <= kAccuracy) return next;
      t = next;
      continue;
    }
    t = 0.5 * (low + high);
    if (t == low || t == high) break;
  }
  return t;
}

// Roots of the derivative within (0, 1), ascending, from its Bernstein coefficients d[0], d[1], d[2].
SignChanges extrema(const BernsteinCubic& b) {
  const double d0 = b[1] - b[0];
  const double d1 = b[2] - b[1];
  const double d2 = b[3] - b[2];
  SignChanges found;
  // d0 (1-t)^2 + 2 d1 t (1-t) + d2 t^2 = 0 with t = s / (s + 1): d2 s^2 + 2 d1 s + d0 = 0, s > 0.
  const double discriminant = d1 * d1 - d0 * d2;
  if (!(discriminant > 0)) return found;
  const double q = -(d1 + std::copysign(std::sqrt(discriminant), d1));
  // The two roots are s = q / d2 and s = d0 / q; as t = numerator / (numerator + denominator) neither can overflow.
  const auto add = [&found](double numerator, double denominator) {
    const double t = numerator / (numerator + denominator);
    if (t > 0 && t < 1) found.add(t);
  };
  add(q, d2);
  add(d0, q);
  sort_roots(found);
  return found;
}

// Cube roots and angles of the depressed cubic y^3 + 3 p y + 2 q = 0; roots of odd multiplicity. A discriminant within
// `rounding` of zero counts as zero.
SignChanges depressed_roots(double p, double q, double rounding) {
  const double p3 = p * p * p;
  const double discriminant = q * q + p3;
  SignChanges roots;
  if (std::abs(discriminant) <= rounding) {
    roots.add(2 * std::cbrt(-q));  // the double root at -cbrt(-q) is a touch
  } else if (discriminant < 0) {
    const double angle = std::acos(std::clamp(-q / std::sqrt(-p3), -1.0, 1.0)) / 3;
    const double radius = 2 * std::sqrt(-p);
    roots.add(radius * std::cos(angle));
    roots.add(-radius * std::cos(angle + kPi / 3));
    roots.add(-radius * std::cos(angle - kPi / 3));
  } else {
    const double root = std::sqrt(discriminant);
    roots.add(std::cbrt(root - q) - std::cbrt(root + q));
  }
  return roots;
}

SignChanges quadratic_roots(const PowerCubic& c) {
  SignChanges roots;
  const double discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  if (!(discriminant > 0)) return roots;
  const double q = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  roots.add(q / c[2]);
  roots.add(c[0] / q);
  return roots;
}

}  // namespace

PowerCubic power_form(const BernsteinCubic& b) {
  return {b[0], 3 * (b[1] - b[0]), 3 * ((b[2] - b[1]) - (b[1] - b[0])), (b[3] - b[0]) - 3 * (b[2] - b[1])};
}

SignChanges bracketed_sign_changes(const BernsteinCubic& b) {
  SignChanges found;
  // Descartes' rule of signs in Bernstein form: no change of coefficients, no root; one change, one root.
  const int variations = static_cast<int>(is_above(b[0]) != is_above(b[1])) +
                         static_cast<int>(is_above(b[1]) != is_above(b[2])) +
                         static_cast<int>(is_above(b[2]) != is_above(b[3]));
  if (variations == 0) return found;
  const PowerCubic c = power_form(b);
  if (variations == 1) {
    found.add(root_between(c, 0, 1, b[0], b[3]));
    return found;
  }
  // Several roots are possible: examine each piece between the extrema.
  const SignChanges splits = extrema(b);
  double low = 0;
  double value_low = b[0];
  for (int i = 0; i <= splits.count; ++i) {
    const bool is_last = i == splits.count;
    const double high = is_last ? 1 : splits.at[static_cast<std::size_t>(i)];
    const double value_high = is_last ? b[3] : evaluate(c, high);
    if (is_above(value_low) != is_above(value_high)) found.add(root_between(c, low, high, value_low, value_high));
    low = high;
    value_low = value_high;
  }
  return found;
}

SignChanges schwarze_roots(const PowerCubic& c) {
  // A leading coefficient below this fraction of the largest counts as zero. The closed form loses about half the
  // digits of (second coefficient / leading coefficient), so dropping a smaller term does no more harm than keeping it.
  constexpr double kVanishing = 1e-5;
  constexpr double kRounding = 1e-15;
  const double largest = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), std::abs(c[3])});
  SignChanges roots;
  if (std::abs(c[3]) > kVanishing * largest) {
    // Substitute t = y - a / 3 in t^3 + a t^2 + b t + constant to make the quadratic term vanish.
    const double a = c[2] / c[3];
    const double b = c[1] / c[3];
    const double constant = c[0] / c[3];
    const double p = (b - a * a / 3) / 3;
    const double q = (2.0 / 27 * a * a * a - a * b / 3 + constant) / 2;
    const double error_p = kRounding * (std::abs(b) + a * a);
    const double error_q = kRounding * (std::abs(a * a * a) + std::abs(a * b) + std::abs(constant));
    roots = depressed_roots(p, q, 2 * std::abs(q) * error_q + 3 * p * p * error_p);
    for (double& root : roots.at) root -= a / 3;
  } else if (std::abs(c[2]) > kVanishing * largest) {
    roots = quadratic_roots(c);
  } else if (std::abs(c[1]) > kVanishing * largest) {
    roots.add(-c[0] / c[1]);
  }
  // Two Newton steps, where they are small, restore the digits that the closed form lost.
  for (double& root : roots.at)
    for (int i = 0; i < 2; ++i) {
      const double step = evaluate(c, root) / derivative(c, root);
      if (std::abs(step) < 1e-2) root -= step;
    }
  sort_roots(roots);
  return roots;
}

SignChanges schwarze_sign_changes(const BernsteinCubic& b) {
  const SignChanges roots = schwarze_roots(power_form(b));
  const auto is_inside = [](double t) { return t >= 0 && t <= 1; };
  int inside = 0;
  int nearest = -1;  // root nearest to an end of [0, 1]
  double nearest_distance = 0;
  for (int i = 0; i < roots.count; ++i) {
    const double t = roots.at[static_cast<std::size_t>(i)];
    inside += static_cast<int>(is_inside(t));
    const double distance = std::min(std::abs(t), std::abs(t - 1));
    if (nearest >= 0 && !(distance < nearest_distance)) continue;
    nearest = i;
    nearest_distance = distance;
  }
  // Where the signs at the ends contradict the rounded roots, the signs win.
  const bool must_be_odd = is_above(b[0]) != is_above(b[3]);
  const bool repair = ((inside & 1) != 0) != must_be_odd;
  // The closed form found no root at all although there is one.
  if (repair && nearest < 0) return bracketed_sign_changes(b);
  SignChanges found;
  for (int i = 0; i < roots.count; ++i) {
    const double t = roots.at[static_cast<std::size_t>(i)];
    if (is_inside(t) != (repair && i == nearest)) found.add(std::clamp(t, 0.0, 1.0));
  }
  return found;
}

}  // namespace deliso
