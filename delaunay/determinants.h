// The two determinants behind the predicates, for any kind of number: double, DoubleDouble, Expansion.
#pragma once

namespace deliso {

// Three coordinates in some kind of number.
template <class Number>
struct Row {
  Number x;
  Number y;
  Number z;
};

// | a b c |, expanded along z.
template <class Number>
auto determinant3(const Row<Number>& a, const Row<Number>& b, const Row<Number>& c) {
  const auto bc = b.x * c.y - c.x * b.y;
  const auto ca = c.x * a.y - a.x * c.y;
  const auto ab = a.x * b.y - b.x * a.y;
  return a.z * bc + b.z * ca + c.z * ab;
}

// Minus the determinant of the rows (x, y, z, x^2 + y^2 + z^2) of a, b, c, d: positive when the origin lies inside the
// circumball of the positively oriented tetrahedron abcd.
template <class Number>
auto insphere_determinant(const Row<Number>& a, const Row<Number>& b, const Row<Number>& c, const Row<Number>& d) {
  const auto ab = a.x * b.y - b.x * a.y;
  const auto bc = b.x * c.y - c.x * b.y;
  const auto cd = c.x * d.y - d.x * c.y;
  const auto da = d.x * a.y - a.x * d.y;
  const auto ac = a.x * c.y - c.x * a.y;
  const auto bd = b.x * d.y - d.x * b.y;

  const auto abc = a.z * bc - b.z * ac + c.z * ab;
  const auto bcd = b.z * cd - c.z * bd + d.z * bc;
  const auto cda = c.z * da + d.z * ac + a.z * cd;
  const auto dab = d.z * ab + a.z * bd + b.z * da;

  const auto a_lift = a.x * a.x + a.y * a.y + a.z * a.z;
  const auto b_lift = b.x * b.x + b.y * b.y + b.z * b.z;
  const auto c_lift = c.x * c.x + c.y * c.y + c.z * c.z;
  const auto d_lift = d.x * d.x + d.y * d.y + d.z * d.z;
  return (c_lift * dab - d_lift * abc) + (a_lift * bcd - b_lift * cda);
}

}  // namespace deliso
