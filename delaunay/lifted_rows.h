// The lifted rows of the insphere determinant, relative to the point being inserted, of every vertex that the search
// for its conflict region meets. Each vertex is loaded, translated and lifted once per insertion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/huge_pages.h"
#include "delaunay/base/pair.h"
#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

// (x, y, z, w = x^2 + y^2 + z^2) of a vertex relative to the inserted point; (0, 0, 0, 1) for the infinite vertex,
// which turns the insphere determinant of a ghost into the orientation of its hull facet.
struct alignas(32) LiftedRow {
  Pair xy;
  Pair zw;
  [[nodiscard]] double w() const { return zw[1]; }
};

// The six 2 x 2 minors of two rows, each beside the one of the other two columns: columns xy and zw, xz and yw, xw and
// yz.
struct RowMinors {
  Pair xy_zw, xz_yw, xw_yz;

  RowMinors(const LiftedRow& a, const LiftedRow& b) {
    const Pair of_xy = a.xy * swapped(b.xy);
    const Pair of_zw = a.zw * swapped(b.zw);
    xy_zw = Pair{of_xy[0], of_zw[0]} - Pair{of_xy[1], of_zw[1]};
    xz_yw = a.xy * b.zw - a.zw * b.xy;
    xw_yz = a.xy * swapped(b.zw) - swapped(a.zw) * b.xy;
  }
};

// The determinant of four rows, by Laplace expansion along the first two.
inline double determinant(const RowMinors& ab, const RowMinors& cd) {
  const Pair sums = ab.xy_zw * swapped(cd.xy_zw) - ab.xz_yw * swapped(cd.xz_yw) + ab.xw_yz * swapped(cd.xw_yz);
  return sums[0] + sums[1];
}

// Whether the sign of a determinant of four lifted rows is certain, from the product of their w's and the greatest w.
//
// A monomial is off by at most 18 u (3 u and 5 u for the rows, 2 * 2 u for the minors, u for their product, at most 5 u
// for the sum), and the permanent of three rows is at most 6 / sqrt(27) times the product of their lengths sqrt(w)
// (Carlen, Lieb, Loss: An inequality of Hadamard type for permanents, 2006). So the determinant is off by at most
// 20 u * 4 * 1.1548 times all four lengths times the greatest one: compare squares, guarded against underflow.
inline bool is_certain(double determinant, double product, double greatest) {
  constexpr double kRelative = 20 * 0x1p-53 * 4 * 1.1548;
  return determinant * determinant > kRelative * kRelative * product * greatest + 0x1p-960;
}

// A sparse set of vertices, in the order in which they were met, with their rows. Position 0 is the infinite vertex.
class LiftedRows {
 public:
  static constexpr std::uint32_t kInfinite = 0;

  // Forgets all vertices but the infinite one. Vertices to come are below vertex_count.
  void start(const Vec3& p, std::size_t vertex_count) {
    if (position_.size() < vertex_count) position_.resize(vertex_count);
    if (ids_.empty()) grow();
    origin_ = p;
    size_ = 1;
  }

  // Reserves room for so many more vertices.
  void reserve_more(std::uint32_t count) {
    if (size_ + count >= ids_.size()) [[unlikely]] {
      grow();
    }
  }

  // Returns the position of v, which is at `point`; adds v if it is new. There must be room for one more. Whether v is
  // new is unpredictable, so there is no branch on it: the row is always written, at worst beyond the end.
  std::uint32_t add(VertexId v, const Vec3& point) {
    std::uint32_t& position = position_[v.index()];
    // Masks, because compilers tend to turn conditional expressions into branches.
    const std::uint32_t candidate = position & (0u - ((position - size_) >> 31));  // 0 unless below size_
    const auto is_new = static_cast<std::uint32_t>(ids_[candidate] != v);
    const std::uint32_t result = candidate ^ ((candidate ^ size_) & (0u - is_new));
    ids_[size_] = v;
    rows_[size_] = lifted(point - origin_);
    position = result;
    size_ += is_new;
    return result;
  }

  // The position of a vertex that has been added, not of the infinite one.
  [[nodiscard]] std::uint32_t find(VertexId v) const { return position_[v.index()]; }

  // The least squared distance of a vertex from the inserted point; infinite when there is none.
  [[nodiscard]] double nearest_squared() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 1; i < size_; ++i) nearest = std::min(nearest, rows_[i].w());
    return nearest;
  }

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] VertexId id(std::uint32_t position) const { return ids_[position]; }
  [[nodiscard]] const LiftedRow& row(std::uint32_t position) const { return rows_[position]; }

 private:
  static LiftedRow lifted(const Vec3& d) { return {Pair{d.x, d.y}, Pair{d.z, d.x * d.x + d.y * d.y + d.z * d.z}}; }
  void grow() {
    const std::size_t capacity = std::max<std::size_t>(64, 2 * ids_.size());
    ids_.resize(capacity, kInfiniteVertex);
    rows_.resize(capacity, LiftedRow{Pair{0, 0}, Pair{0, 1}});
  }

  Vec3 origin_;
  std::uint32_t size_ = 1;
  LargeArray<std::uint32_t> position_;  // of each vertex of the triangulation; valid only if ids_ agrees
  std::vector<VertexId> ids_;
  std::vector<LiftedRow> rows_;
};

}  // namespace deliso
