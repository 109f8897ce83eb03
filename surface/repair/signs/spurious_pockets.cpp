#include "surface/repair/signs/spurious_pockets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/predicates.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

constexpr std::size_t kLargestPocket = 100;

bool holds(const SignedDelaunay& restricted, TetId t, const Vec3& p) {
  const auto& v = restricted.delaunay().vertices(t);
  for (const auto& slots : kFacetSlots) {
    const Vec3& a = restricted.delaunay().point(v[slots[0]]);
    const Vec3& b = restricted.delaunay().point(v[slots[1]]);
    const Vec3& c = restricted.delaunay().point(v[slots[2]]);
    if (orient3d(a, b, c, p) > 0) return false;  // beyond a facet
  }
  return true;
}

// Whether a tetrahedron contains a sample whose side is the tetrahedron's sign.
bool has_sample_of_its_sign(const SignedDelaunay& restricted, TetId t) {
  const Isosurface& isosurface = restricted.isosurface();
  const ScalarGrid& grid = isosurface.grid();
  const Vec3& step = isosurface.step();
  Box3 box;
  for (const VertexId v : restricted.delaunay().vertices(t)) box.extend(restricted.delaunay().point(v));
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = static_cast<std::int32_t>(std::max(0.0, std::ceil(box.low[axis] / step[axis])));
    high[axis] = static_cast<std::int32_t>(std::min(grid.dims()[axis] - 1.0, std::floor(box.high[axis] / step[axis])));
  }
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) {
        if ((grid.at(i, j, k) > isosurface.isovalue()) != restricted.is_above(t)) continue;
        const Vec3 sample{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        if (holds(restricted, t, scaled(sample, step))) return true;
      }
    }
  }
  return false;
}

using Pocket = std::vector<TetId>;

// Searches pockets one by one.
class PocketSearch {
 public:
  explicit PocketSearch(const SignedDelaunay& restricted)
      : restricted_(restricted), state_(restricted.delaunay().tet_slots(), State::kUnseen) {}

  // Floods the face-connected set of tetrahedra of one sign around a seed. Returns false as soon as the set turns out
  // to have been seen, to be too large or to have a ghost.
  bool floods_pocket(TetId seed);
  [[nodiscard]] const Pocket& flood() const { return flood_; }
  [[nodiscard]] bool is_spurious() const {
    return std::none_of(flood_.begin(), flood_.end(), [&](TetId t) { return has_sample_of_its_sign(restricted_, t); });
  }

 private:
  enum class State : std::uint8_t { kUnseen, kPocket, kExcluded };

  const SignedDelaunay& restricted_;
  std::vector<State> state_;  // by slot
  Pocket flood_;
};

bool PocketSearch::floods_pocket(TetId seed) {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  if (state_[seed.index()] != State::kUnseen || !delaunay.is_live(seed)) return false;
  flood_.assign(1, seed);
  state_[seed.index()] = State::kPocket;
  bool is_pocket = true;
  for (std::size_t at = 0; at < flood_.size() && is_pocket; ++at) {
    is_pocket = !delaunay.is_ghost(flood_[at]);
    for (unsigned face = 0; face < 4 && is_pocket; ++face) {
      const TetId next = delaunay.neighbour(flood_[at], face);
      State& state = state_[next.index()];
      if (restricted_.is_above(next) != restricted_.is_above(seed) || state == State::kPocket) continue;
      is_pocket = state == State::kUnseen && flood_.size() < kLargestPocket;
      if (!is_pocket) break;
      state = State::kPocket;
      flood_.push_back(next);
    }
  }
  if (!is_pocket) {
    for (const TetId t : flood_) state_[t.index()] = State::kExcluded;
  }
  return is_pocket;
}

}  // namespace

// Every share of the slots is searched independently; its floods may leave the share. A pocket is found by the share
// that holds its lowest slot, when that slot is the seed.
std::vector<Pocket> spurious_pockets(const SignedDelaunay& restricted, int threads) {
  const Shares shares(restricted.delaunay().tet_slots(), threads);
  std::vector<std::vector<Pocket>> found(shares.count());
  shares.for_each(threads, [&](std::size_t share, std::size_t first, std::size_t last) {
    PocketSearch search(restricted);
    for (std::size_t i = first; i < last; ++i) {
      if (!search.floods_pocket(TetId(i))) continue;
      const bool is_own = *std::min_element(search.flood().begin(), search.flood().end()) == TetId(i);
      if (is_own && search.is_spurious()) found[share].push_back(search.flood());
    }
  });
  std::vector<Pocket> pockets;
  for (std::vector<Pocket>& some : found) std::move(some.begin(), some.end(), std::back_inserter(pockets));
  return pockets;
}

std::size_t flip_spurious_pockets(SignedDelaunay& restricted, int threads) {
  const std::vector<Pocket> pockets = spurious_pockets(restricted, threads);
  for (const Pocket& pocket : pockets) {
    for (const TetId t : pocket) restricted.flip_sign(t);
  }
  return pockets.size();
}

}  // namespace deliso
