#include "surface/repair/signs/spurious_pockets.h"

#include <algorithm>
#include <cmath>
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
bool has_sample_of_its_sign(const SignedDelaunay& restricted, const ScalarGrid& grid, TetId t) {
  const Isosurface& isosurface = restricted.isosurface();
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

}  // namespace

SpuriousPockets::SpuriousPockets(const SignedDelaunay& restricted, const ScalarGrid& grid, int threads)
    : restricted_(restricted), delaunay_(restricted.delaunay()), grid_(grid), threads_(threads) {}

void SpuriousPockets::renew(const ExchangedPoints& exchanged) {
  if (signs_.empty()) return;
  signs_.resize(delaunay_.tet_slots(), 0);
  renewed_.insert(renewed_.end(), exchanged.renewed.begin(), exchanged.renewed.end());
}

void SpuriousPockets::update() {
  if (signs_.empty()) return search_all();
  std::vector<bool> touched(signs_.size(), false);
  std::vector<TetId> seeds;
  const auto seed_at = [&](TetId t) {
    seeds.push_back(t);
    if (!delaunay_.is_live(t)) return;
    for (unsigned face = 0; face < 4; ++face) seeds.push_back(delaunay_.neighbour(t, face));
  };
  for (const TetId t : renewed_) {
    signs_[t.index()] = restricted_.is_above(t) ? 1 : 0;
    seed_at(t);
  }
  renewed_.clear();
  restricted_.for_each_change(signs_, seed_at);
  for (const TetId t : seeds) touched[t.index()] = true;
  std::erase_if(pockets_, [&](const Pocket& pocket) {
    return std::any_of(pocket.begin(), pocket.end(), [&](TetId t) { return touched[t.index()]; });
  });
  Search search(signs_.size());
  for (const TetId t : seeds) {
    if (floods_pocket(t, search) && is_spurious(search.flood)) pockets_.push_back(search.flood);
  }
}

// Every share of the slots is searched independently; its floods may leave the share. A pocket is found by the share
// that holds its lowest slot, when that slot is the seed.
void SpuriousPockets::search_all() {
  signs_.assign(delaunay_.tet_slots(), 0);
  restricted_.for_each_change(signs_, [](TetId) {});
  const Shares shares(signs_.size(), threads_);
  std::vector<std::vector<Pocket>> found(shares.count());
  shares.for_each(threads_, [&](std::size_t share, std::size_t first, std::size_t last) {
    Search search(signs_.size());
    for (std::size_t i = first; i < last; ++i) {
      if (!floods_pocket(TetId(i), search)) continue;
      const bool is_own = *std::min_element(search.flood.begin(), search.flood.end()) == TetId(i);
      if (is_own && is_spurious(search.flood)) found[share].push_back(search.flood);
    }
  });
  for (std::vector<Pocket>& some : found) std::move(some.begin(), some.end(), std::back_inserter(pockets_));
}

// Floods the face-connected set of tetrahedra of one sign around an unseen seed. Returns false as soon as the set turns
// out to be too large or to have a ghost.
bool SpuriousPockets::floods_pocket(TetId seed, Search& search) const {
  if (search.state[seed.index()] != State::kUnseen || !delaunay_.is_live(seed)) return false;
  Pocket& flood = search.flood;
  flood.assign(1, seed);
  search.state[seed.index()] = State::kPocket;
  bool is_pocket = true;
  for (std::size_t at = 0; at < flood.size() && is_pocket; ++at) {
    is_pocket = !delaunay_.is_ghost(flood[at]);
    for (unsigned face = 0; face < 4 && is_pocket; ++face) {
      const TetId next = delaunay_.neighbour(flood[at], face);
      State& state = search.state[next.index()];
      if (restricted_.is_above(next) != restricted_.is_above(seed) || state == State::kPocket) continue;
      is_pocket = state == State::kUnseen && flood.size() < kLargestPocket;
      if (!is_pocket) break;
      state = State::kPocket;
      flood.push_back(next);
    }
  }
  if (!is_pocket) {
    for (const TetId t : flood) search.state[t.index()] = State::kExcluded;
  }
  return is_pocket;
}

bool SpuriousPockets::is_spurious(const Pocket& pocket) const {
  return std::none_of(pocket.begin(), pocket.end(),
                      [&](TetId t) { return has_sample_of_its_sign(restricted_, grid_, t); });
}

std::int64_t SpuriousPockets::flip(SignedDelaunay& restricted) {
  update();
  for (const auto& pocket : pockets_) {
    for (const TetId t : pocket) restricted.flip_sign(t);
  }
  return static_cast<std::int64_t>(pockets_.size());
}

}  // namespace deliso
