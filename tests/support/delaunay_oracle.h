// Exact oracles for the Delaunay tests. They work on integers and share no code with the predicates they check: the
// determinants are written out over absolute coordinates, not differences, and expanded along the first column.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/tetrahedralization.h"
#include "delaunay/validate.h"
#include "tests/support/delaunay_big_integer.h"

namespace deliso::test {

// A matrix of exact numbers.
using Matrix = std::vector<std::vector<BigInteger>>;

// The determinant by cofactors of the first column.
inline BigInteger determinant(const Matrix& m) {
  if (m.size() == 1) return m[0][0];
  BigInteger sum;
  for (std::size_t row = 0; row < m.size(); ++row) {
    if (m[row][0].sign() == 0) continue;
    Matrix minor;
    for (std::size_t i = 0; i < m.size(); ++i) {
      if (i != row) minor.emplace_back(m[i].begin() + 1, m[i].end());
    }
    const BigInteger term = m[row][0] * determinant(minor);
    sum = row % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

// Coordinates times 2^shift must be integers.
inline std::vector<BigInteger> exact_point(const Vec3& p, int shift) {
  return {BigInteger::from_double(p.x, shift), BigInteger::from_double(p.y, shift),
          BigInteger::from_double(p.z, shift)};
}

// orient3d as the determinant of the rows (1, x, y, z), times 2^(3 shift).
inline BigInteger exact_orient3d(const std::array<Vec3, 4>& points, int shift) {
  Matrix m;
  for (const Vec3& p : points) {
    m.push_back({1});
    for (const BigInteger& coordinate : exact_point(p, shift)) m.back().push_back(coordinate);
  }
  return determinant(m);
}

// The sign of insphere as the determinant of the rows (1, x, y, z, x^2 + y^2 + z^2).
inline int exact_insphere(const std::array<Vec3, 5>& points, int shift) {
  Matrix m;
  for (const Vec3& p : points) {
    const auto q = exact_point(p, shift);
    m.push_back({1, q[0], q[1], q[2], q[0] * q[0] + q[1] * q[1] + q[2] * q[2]});
  }
  // For (0, x, y, z) and an interior point the matrix has a negative determinant.
  return -determinant(m).sign();
}

// insphere with the lifted coordinate of point i raised by an actual number: 2^ranks[i] for pairwise different ranks,
// after scaling all exact lifts by 2^-(deep), so deep that the raised amounts cannot change a sign that is not zero.
inline int exact_perturbed_insphere(const std::array<Vec3, 5>& points, const std::array<unsigned, 5>& ranks,
                                    int shift) {
  constexpr unsigned kStep = 200;  // bits between two perturbations: more than any orientation has
  const auto power = [](unsigned exponent) {
    BigInteger value = 1;
    for (unsigned i = 0; i < exponent; ++i) value = value + value;
    return value;
  };
  unsigned greatest = 0;
  for (const unsigned rank : ranks) greatest = std::max(greatest, rank);
  const BigInteger unit = power(kStep * (greatest + 2));
  Matrix m;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto q = exact_point(points[i], shift);
    m.push_back({1, q[0], q[1], q[2]});
    m.back().push_back((q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) * unit + power(kStep * ranks[i]));
  }
  return -determinant(m).sign();
}

// The tetrahedra as sets of vertices, ghosts with the infinite vertex: what two triangulations are compared by.
inline std::set<std::array<std::uint32_t, 4>> tetrahedra_as_sets(const Tetrahedralization& tets) {
  std::set<std::array<std::uint32_t, 4>> result;
  for (std::size_t i = 0; i < tets.tet_slots(); ++i) {
    if (!tets.is_live(TetId(i))) continue;
    std::array<std::uint32_t, 4> key{};
    for (unsigned slot = 0; slot < 4; ++slot) key[slot] = tets.vertices(TetId(i))[slot].value;
    std::sort(key.begin(), key.end());
    result.insert(key);
  }
  return result;
}

// Any live tetrahedron: where a search may start.
inline TetId some_live_tet(const Tetrahedralization& tets, Rng& rng) {
  for (;;) {
    const TetId t(rng.below(tets.tet_slots()));
    if (tets.is_live(t)) return t;
  }
}

// What is wrong with a triangulation, or "none".
inline std::string violation_of(const Tetrahedralization& tets) { return find_violation(tets).value_or("none"); }

}  // namespace deliso::test
