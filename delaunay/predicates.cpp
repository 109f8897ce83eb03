#include "delaunay/predicates.h"

#include <cmath>

#include "delaunay/determinants.h"
#include "delaunay/expansion.h"

namespace deliso {
namespace {

constexpr double kUlp = 0x1p-53;  // half a unit in the last place of 1

// Error of determinant3 and insphere_determinant on rounded differences, relative to their permanents (Shewchuk, 1997,
// section 4: stage A bounds).
constexpr double kOrientErrorDouble = (7 + 56 * kUlp) * kUlp;
constexpr double kInsphereErrorDouble = (16 + 224 * kUlp) * kUlp;
// The same in double-double, on exact differences. A monomial passes through at most 5 (11) operations of relative
// error 8 u^2 each, so the error is below 41 u^2 (90 u^2) permanents; rounded up to leave room for the rounding of the
// permanent itself.
constexpr double kOrientErrorDoubleDouble = 64 * kUlp * kUlp;
constexpr double kInsphereErrorDoubleDouble = 128 * kUlp * kUlp;
// orient3d accepts a stage only when its error is this much smaller than its value.
constexpr double kOrientRelativeError = 0x1p-20;

Row<double> rounded_difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

template <class Number>
Row<Number> exact_difference(const Vec3& a, const Vec3& b) {
  return {Number(two_difference(a.x, b.x)), Number(two_difference(a.y, b.y)), Number(two_difference(a.z, b.z))};
}

Row<double> magnitudes(const Row<double>& a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }

// | a b c | with every minus sign turned into plus, for rows of magnitudes.
double permanent3(const Row<double>& a, const Row<double>& b, const Row<double>& c) {
  return a.z * (b.x * c.y + c.x * b.y) + b.z * (c.x * a.y + a.x * c.y) + c.z * (a.x * b.y + b.x * a.y);
}

Row<double> are_not_zero(const Row<double>& a) {
  return {a.x != 0 ? 1.0 : 0.0, a.y != 0 ? 1.0 : 0.0, a.z != 0 ? 1.0 : 0.0};
}

double lift(const Row<double>& a) { return a.x * a.x + a.y * a.y + a.z * a.z; }

double exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using Number = Expansion<2>;
  return determinant3(exact_difference<Number>(b, a), exact_difference<Number>(c, a), exact_difference<Number>(d, a))
      .estimate();
}

double exact_insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  using Number = Expansion<2>;
  return insphere_determinant(exact_difference<Number>(a, e), exact_difference<Number>(b, e),
                              exact_difference<Number>(c, e), exact_difference<Number>(d, e))
      .estimate();
}

// The sign of (b - a) x (c - a) in a plane, exactly.
int sign_in_plane(double ax, double ay, double bx, double by, double cx, double cy) {
  // Shewchuk's bound of the rounded determinant (1997); the summand covers products that underflow.
  constexpr double kRelative = 3.3306690738754716e-16, kUnderflow = 1e-300;
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax);
  const double rounded = left - right;
  if (std::abs(rounded) > kRelative * (std::abs(left) + std::abs(right)) + kUnderflow) return rounded > 0 ? 1 : -1;

  using Number = Expansion<2>;
  const Number ux(two_difference(bx, ax));
  const Number uy(two_difference(by, ay));
  const Number vx(two_difference(cx, ax));
  const Number vy(two_difference(cy, ay));
  const double exact = (ux * vy - uy * vx).estimate();
  return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

}  // namespace

double orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // Stage 1: rounded differences, with a dynamic error bound.
  const Row<double> ab = rounded_difference(b, a);
  const Row<double> ac = rounded_difference(c, a);
  const Row<double> ad = rounded_difference(d, a);
  const double det = determinant3(ab, ac, ad);
  const double permanent = permanent3(magnitudes(ab), magnitudes(ac), magnitudes(ad));
  if (std::abs(det) * kOrientRelativeError > kOrientErrorDouble * permanent) return det;
  // The points lie in a plane across an axis, or three of them on a line along one: every monomial has a zero factor.
  if (permanent == 0 && permanent3(are_not_zero(ab), are_not_zero(ac), are_not_zero(ad)) == 0) return 0;
  if (b == c || b == d || c == d) return 0;

  // Stage 2: exact differences, double-double determinant.
  using Number = DoubleDouble;
  const DoubleDouble finer =
      determinant3(exact_difference<Number>(b, a), exact_difference<Number>(c, a), exact_difference<Number>(d, a));
  if (std::abs(finer.high) * kOrientRelativeError > kOrientErrorDoubleDouble * permanent) return finer.high;

  // Stage 3: exact.
  return exact_orient3d(a, b, c, d);
}

double insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  // Stage 1: rounded differences, with a dynamic error bound.
  const Row<double> ea = rounded_difference(a, e);
  const Row<double> eb = rounded_difference(b, e);
  const Row<double> ec = rounded_difference(c, e);
  const Row<double> ed = rounded_difference(d, e);
  const double det = insphere_determinant(ea, eb, ec, ed);
  const Row<double> am = magnitudes(ea);
  const Row<double> bm = magnitudes(eb);
  const Row<double> cm = magnitudes(ec);
  const Row<double> dm = magnitudes(ed);
  const double permanent = lift(ea) * permanent3(bm, cm, dm) + lift(eb) * permanent3(am, cm, dm) +
                           lift(ec) * permanent3(am, bm, dm) + lift(ed) * permanent3(am, bm, cm);
  if (std::abs(det) > 1.001 * kInsphereErrorDouble * permanent) return det;

  // Stage 2: exact differences, double-double determinant.
  using Number = DoubleDouble;
  const DoubleDouble finer = insphere_determinant(exact_difference<Number>(a, e), exact_difference<Number>(b, e),
                                                  exact_difference<Number>(c, e), exact_difference<Number>(d, e));
  if (std::abs(finer.high) > kInsphereErrorDoubleDouble * permanent) return finer.high;

  // Stage 3: exact.
  return exact_insphere(a, b, c, d, e);
}

bool perturbed_insphere(const std::array<Vec3, 4>& tet, const std::array<VertexId, 4>& ids, const Vec3& p,
                        VertexId p_id) {
  // The lifted coordinate of vertex i is raised by eps_i, where eps_i outweighs all eps_j with j < i. The insphere
  // determinant then gains, for each vertex of the tetrahedron, eps times the orientation with p in its place, and for
  // p itself eps times minus the orientation of the tetrahedron. The highest vertex with a coefficient decides.
  std::array<unsigned, 4> slots = {0, 1, 2, 3};
  for (unsigned i = 1; i < 4; ++i) {
    for (unsigned j = i; j > 0 && ids[slots[j - 1]] < ids[slots[j]]; --j) std::swap(slots[j - 1], slots[j]);
  }
  for (const unsigned slot : slots) {
    if (ids[slot] < p_id) return false;
    std::array<Vec3, 4> replaced = tet;
    replaced[slot] = p;
    const double orientation = orient3d(replaced[0], replaced[1], replaced[2], replaced[3]);
    if (orientation != 0) return orientation > 0;
  }
  return false;
}

int normal_sign(const Vec3& a, const Vec3& b, const Vec3& c, unsigned axis) {
  const unsigned u = (axis + 1) % 3;
  const unsigned v = (axis + 2) % 3;
  return sign_in_plane(a[u], a[v], b[u], b[v], c[u], c[v]);
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return normal_sign(a, b, c, 2) == 0 && normal_sign(a, b, c, 0) == 0 && normal_sign(a, b, c, 1) == 0;
}

}  // namespace deliso
