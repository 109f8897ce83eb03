// Triangles in a hierarchical hash grid: which of them may meet a box. For sets that change all the time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

// Level l has cells of 2^l mesh-space units, or smaller by one factor for all. A triangle is stored at the first level
// whose cells are more than twice as large as its box, in the cell of the box's low corner.
class TriangleHashGrid {
 public:
  TriangleHashGrid() = default;
  // For a set whose triangles have edges about this long (mesh-space units): where these are short, levels begin with
  // smaller cells, so that none holds hundreds of triangles.
  explicit TriangleHashGrid(double edge);

  [[nodiscard]] bool holds(std::uint32_t triangle) const { return triangle < held_.size() && held_[triangle] != 0; }
  // Precondition of add(): not stored yet; of remove(): stored, with the same box. Triangles whose box is too large for
  // every level are left out.
  void add(std::uint32_t triangle, const Box3& box);
  void remove(std::uint32_t triangle, const Box3& box);

  // Appends all whose boxes meet `box` when both are rounded to floats, which keeps the order of numbers.
  void append_near(const Box3& box, std::vector<std::uint32_t>& found) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  static constexpr std::size_t kPerRow = 4;

  struct FloatBox {
    explicit FloatBox(const Box3& box);
    std::array<float, 3> low, high;
  };
  // Triangles and their boxes, side by side; an unused entry has an empty box.
  struct Row {
    std::array<std::array<float, kPerRow>, 3> low, high;
    std::array<std::uint32_t, kPerRow> triangles;

    Row();
    void set(std::size_t i, std::uint32_t triangle, const FloatBox& box);
    void set(std::size_t i, const Row& from, std::size_t j);
    void clear(std::size_t i);
    // Bit i: whether box i meets another one.
    [[nodiscard]] std::uint32_t meeting(const FloatBox& other) const;
    [[nodiscard]] std::size_t count() const;
  };
  struct Cell {
    std::uint64_t key = kNoKey;
    std::vector<Row> rows;  // all full but the last one
  };
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
  static constexpr int kLevels = 63;

  // Cells of a level, or blocks of them: those from one to another along each axis.
  using Place = std::array<std::int32_t, 3>;
  struct Range {
    Place low{}, high{};
    [[nodiscard]] double count() const;
    [[nodiscard]] bool contains(const Place& place) const;
    template <class Visit>
    void for_each(Visit&& visit) const;
  };

  [[nodiscard]] int level_of(const Box3& box) const;
  [[nodiscard]] double scale_of(int level) const;
  [[nodiscard]] Place place_of(const Vec3& point, int level) const;
  [[nodiscard]] Range cells_near(const Box3& box, int level) const;
  static Range blocks_of(const Range& cells);
  static std::uint64_t cell_key(int level, const Place& place);
  static std::uint64_t block_key(int level, const Place& place);
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  Cell& cell_at(int level, const Place& place);
  bool insert(std::uint64_t key, std::size_t& slot);
  void grow();
  template <class Visit>
  void for_each_used_cell(const Range& cells, int level, Visit&& visit) const;

  static constexpr double kSmallest = 0.5;  // mesh-space units, see smallest_
  int finer_ = 0;                           // cells are smaller by 2 to this power
  double smallest_ = kSmallest;             // boxes smaller than this share a level
  // A hash table with open addressing, of cells and of the blocks that hold some; both stay in it when they become
  // empty.
  std::vector<Cell> cells_ = std::vector<Cell>(64);
  std::size_t used_ = 0;
  std::array<std::vector<Place>, kLevels> blocks_;  // the used ones
  std::array<std::size_t, kLevels> kept_at_{};      // triangles at each level
  std::uint64_t levels_ = 0;                        // bit i: whether there are any at level i
  std::vector<std::uint8_t> held_;                  // of each triangle: whether it is stored
};

}  // namespace deliso
