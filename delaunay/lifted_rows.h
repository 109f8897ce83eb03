// The lifted rows of the insphere determinant, relative to the point being inserted, of every vertex that the search
// for its conflict region meets. Each vertex is loaded, translated and lifted once per insertion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/huge_pages.h"
#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

// (x, y, z, x^2 + y^2 + z^2) of a vertex relative to the inserted point; (0, 0, 0, 1) for the infinite vertex, which
// turns the insphere determinant of a ghost into the orientation of its hull facet.
struct alignas(32) LiftedRow {
  double x;
  double y;
  double z;
  double w;
};

// The six 2 x 2 minors of two rows.
struct RowMinors {
  double xy, xz, xw, yz, yw, zw;

  RowMinors(const LiftedRow& a, const LiftedRow& b)
      : xy(a.x * b.y - a.y * b.x),
        xz(a.x * b.z - a.z * b.x),
        xw(a.x * b.w - a.w * b.x),
        yz(a.y * b.z - a.z * b.y),
        yw(a.y * b.w - a.w * b.y),
        zw(a.z * b.w - a.w * b.z) {}
};

// The determinant of four rows, by Laplace expansion along the first two.
inline double determinant(const RowMinors& ab, const RowMinors& cd) {
  return ((ab.xy * cd.zw - ab.xz * cd.yw) + (ab.xw * cd.yz + ab.yz * cd.xw)) + (ab.zw * cd.xy - ab.yw * cd.xz);
}

// Whether the sign of a determinant of four lifted rows is certain, from the product of their w's and the greatest w.
//
// A monomial is off by at most 18 u (3 u and 5 u for the rows, 2 * 2 u for the minors, u for their product, 5 u for the
// sum), and the permanent of three rows is at most 6 / sqrt(27) times the product of their lengths sqrt(w) (Carlen,
// Lieb, Loss: An inequality of Hadamard type for permanents, 2006). So the determinant is off by at most
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

  // Makes room for so many more vertices.
  void reserve_more(std::uint32_t count) {
    if (size_ + count >= ids_.size()) [[unlikely]] {
      grow();
    }
  }

  // The position of v, which is at `point`; added if it is new. There must be room for one more. Whether it is new is
  // unpredictable, so there is no branch on it: the row is written either way, beyond the end if it is not needed.
  std::uint32_t add(VertexId v, const Vec3& point) {
    std::uint32_t& position = position_[v.index()];
    const std::uint32_t candidate = position < size_ ? position : kInfinite;
    const bool is_new = ids_[candidate] != v;
    const std::uint32_t result = is_new ? size_ : candidate;
    const Vec3 d = point - origin_;
    ids_[size_] = v;
    rows_[size_] = {d.x, d.y, d.z, d.x * d.x + d.y * d.y + d.z * d.z};
    position = result;
    size_ += static_cast<std::uint32_t>(is_new);
    return result;
  }

  // The position of a vertex that has been added, or of the infinite vertex.
  [[nodiscard]] std::uint32_t find(VertexId v) const { return v == kInfiniteVertex ? kInfinite : position_[v.index()]; }

  // The least squared distance of a vertex from the inserted point; infinite when there is none.
  [[nodiscard]] double nearest_squared() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 1; i < size_; ++i) nearest = std::min(nearest, rows_[i].w);
    return nearest;
  }

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] VertexId id(std::uint32_t position) const { return ids_[position]; }
  [[nodiscard]] const LiftedRow& row(std::uint32_t position) const { return rows_[position]; }

 private:
  void grow() {
    const std::size_t capacity = std::max<std::size_t>(64, 2 * ids_.size());
    ids_.resize(capacity, kInfiniteVertex);
    rows_.resize(capacity, LiftedRow{0, 0, 0, 1});
  }

  Vec3 origin_;
  std::uint32_t size_ = 1;
  LargeArray<std::uint32_t> position_;  // of each vertex of the triangulation; right only if ids_ agrees
  std::vector<VertexId> ids_;
  std::vector<LiftedRow> rows_;
};

}  // namespace deliso
