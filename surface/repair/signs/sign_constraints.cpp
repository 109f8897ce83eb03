#include "surface/repair/signs/sign_constraints.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "delaunay/predicates.h"
#include "surface/base/parallel_blocks.h"
#include "volume/topology/cell_sweep.h"
#include "volume/topology/critical_points.h"

namespace deliso {

namespace {

// A segment that passes through a tetrahedron for this share of its length or less touches an edge or a vertex of it,
// but for rounding. In noise such tetrahedra are touched by segments of both sides.
constexpr double kShortest = 1e-9;

// The number of cells that a thread takes at a time.
constexpr std::size_t kCellsAtOnce = 64;

Vec3 corner_position(unsigned corner) {
  return {static_cast<double>(corner & 1u), static_cast<double>(corner >> 1 & 1u), static_cast<double>(corner >> 2)};
}

class Collector {
 public:
  Collector(const SignedDelaunay& restricted, std::vector<std::uint8_t>& sides)
      : restricted_(restricted),
        delaunay_(restricted.delaunay()),
        grid_(restricted.isosurface().grid()),
        sides_(sides),
        hint_(delaunay_.incident_tet(VertexId(std::size_t{0}))) {}

  // Notes the constraints from the segments of a cell; returns the tetrahedra that the segments cross. One of those
  // that they crossed before is a good place to begin at.
  std::vector<TetId> collect(const CellIndex& cell, std::span<const TetId> crossed_before);

 private:
  void collect_edges(const CellIndex& cell, const CellCorners& corners);
  void collect_critical_points(const CellIndex& cell, const CellCorners& corners);
  void follow(const Vec3& a, TetId at_a, const Vec3& b, std::uint8_t side);
  TetId note(const Vec3& p, std::uint8_t side);
  // A corner of the current cell; each is located once, from a corner that an edge joins to it.
  TetId note_corner(const CellIndex& cell, unsigned corner, std::uint8_t side) {
    TetId& at = at_corner_[corner];
    if (!at.is_none()) return at;
    for (unsigned axis = 1; axis <= 4; axis *= 2) {
      if (const TetId near = at_corner_[corner ^ axis]; !near.is_none()) hint_ = near;
    }
    return at = note(position(cell, corner_position(corner)), side);
  }
  void note_located(const Vec3& p, std::uint8_t side);
  void note_ghosts(TetId t, const Vec3& p, const Vec3& q, std::uint8_t side);
  // Several collectors may call this at the same time; the result does not depend on the order.
  void note_at(TetId t, std::uint8_t side) {
    const std::atomic_ref<std::uint8_t> noted(sides_[t.index()]);
    if ((noted.load(std::memory_order_relaxed) & side) == 0) noted.fetch_or(side, std::memory_order_relaxed);
  }
  [[nodiscard]] Vec3 position(const CellIndex& cell, const Vec3& uvw) const {
    return scaled({cell[0] + uvw.x, cell[1] + uvw.y, cell[2] + uvw.z}, restricted_.isosurface().step());
  }
  [[nodiscard]] std::uint8_t side_of(double value) const {
    return value > restricted_.isosurface().isovalue() ? kAbove : kBelow;
  }

  const SignedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const ScalarGrid& grid_;
  std::vector<std::uint8_t>& sides_;  // shared by all collectors
  TetId hint_;
  std::vector<CriticalPoint> critical_;
  // State of the current cell:
  Vec3 center_;
  std::array<TetId, 8> at_corner_;
  std::vector<TetId> trace_;
  std::vector<Passage> passed_;  // by the latest segment
};

std::vector<TetId> Collector::collect(const CellIndex& cell, std::span<const TetId> crossed_before) {
  for (const TetId t : crossed_before) {
    if (delaunay_.is_live(t)) hint_ = t;
  }
  trace_.clear();
  at_corner_.fill(TetId::none());
  center_ = position(cell, {0.5, 0.5, 0.5});
  const CellCorners corners = grid_.cell(cell[0], cell[1], cell[2]);
  collect_edges(cell, corners);
  collect_critical_points(cell, corners);
  std::sort(trace_.begin(), trace_.end());
  trace_.erase(std::unique(trace_.begin(), trace_.end()), trace_.end());
  return {trace_.begin(), trace_.end()};
}

void Collector::collect_edges(const CellIndex& cell, const CellCorners& corners) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 1; axis <= 4; axis *= 2) {
      if ((corner & axis) != 0) continue;
      const std::uint8_t side = side_of(corners[corner]);
      if (side != side_of(corners[corner | axis])) continue;
      unsigned a = corner, b = corner | axis;
      if (delaunay_.is_ghost(note_corner(cell, a, side))) std::swap(a, b);
      const TetId at_a = note_corner(cell, a, side);
      if (delaunay_.is_ghost(at_a)) continue;  // the hull does not reach to either corner
      const Vec3 to = position(cell, corner_position(b));
      follow(position(cell, corner_position(a)), at_a, to, side);
      if (at_corner_[b].is_none()) {
        hint_ = at_corner_[b] = passed_.empty() ? at_a : passed_.back().tet;
        note_located(to, side);
      }
    }
  }
}

// Saddles of faces with the segments to the corners of their face that lie farther on their side; saddles of the body
// as points.
void Collector::collect_critical_points(const CellIndex& cell, const CellCorners& corners) {
  critical_.clear();
  append_critical_points(corners, critical_);
  for (const CriticalPoint& c : critical_) {
    const int known = side_of_saddle(corners, restricted_.isosurface().isovalue(), c);
    if (known == 0) continue;
    const std::uint8_t side = known > 0 ? kAbove : kBelow;
    const Vec3 p = position(cell, c.uvw);
    note(p, side);
    if (c.face < 0) continue;
    for (const int corner : face_corners(c.face)) {
      const double value = corners[static_cast<std::size_t>(corner)];
      if (side_of(value) == side && (value > c.value) == (side == kAbove)) {
        // The segment is moved as a whole, as its corner is.
        const Vec3 to = position(cell, corner_position(static_cast<unsigned>(corner)));
        hint_ = restricted_.locate(p, p + (center_ - to), hint_);
        if (!delaunay_.is_ghost(hint_)) follow(p, hint_, to, side);
      }
    }
  }
}

// Notes the tetrahedra that the segment enters after the finite one that holds its first end.
void Collector::follow(const Vec3& a, TetId at_a, const Vec3& b, std::uint8_t side) {
  passed_.clear();
  restricted_.append_passed(a, b, center_, at_a, passed_);
  for (std::size_t i = 0; i < passed_.size(); ++i) {
    const auto [t, entry] = passed_[i];
    trace_.push_back(t);
    const bool is_touched = i + 1 < passed_.size() && passed_[i + 1].entry - entry < kShortest;
    if (!is_touched && !delaunay_.is_ghost(t)) note_at(t, side);
  }
  const Box3& box = restricted_.isosurface().box();
  if (!SignedDelaunay::on_box(box, a) || !SignedDelaunay::on_box(box, b)) return;
  note_ghosts(at_a, a, b, side);
  for (const Passage& p : passed_) note_ghosts(p.tet, a, b, side);
}

TetId Collector::note(const Vec3& p, std::uint8_t side) {
  hint_ = restricted_.locate(p, center_, hint_);
  note_located(p, side);
  return hint_;
}

// Notes the side at the tetrahedron that holds p and, if p lies on the box, at the ghost behind a facet that contains
// p. Other ghosts get no constraint: points beyond the hull say nothing about the hull.
void Collector::note_located(const Vec3& p, std::uint8_t side) {
  trace_.push_back(hint_);
  if (delaunay_.is_ghost(hint_)) return;
  note_at(hint_, side);
  if (SignedDelaunay::on_box(restricted_.isosurface().box(), p)) note_ghosts(hint_, p, p, side);
}

// Notes the side at the ghosts behind those facets of t whose planes contain both points.
void Collector::note_ghosts(TetId t, const Vec3& p, const Vec3& q, std::uint8_t side) {
  if (delaunay_.is_ghost(t)) return;
  for (unsigned face = 0; face < 4; ++face) {
    const TetId across = delaunay_.neighbour(t, face);
    if (!delaunay_.is_ghost(across)) continue;
    const std::array<VertexId, 3> facet = delaunay_.facet_vertices(FacetId(t, face));
    const auto contains = [&](const Vec3& x) {
      return orient3d(delaunay_.point(facet[0]), delaunay_.point(facet[1]), delaunay_.point(facet[2]), x) == 0;
    };
    if (!contains(p) || !contains(q)) continue;
    trace_.push_back(across);
    note_at(across, side);
  }
}

}  // namespace

void SignConstraints::renew(const ExchangedPoints& exchanged) {
  const Tetrahedralization& delaunay = restricted_.delaunay();
  sides_.resize(delaunay.tet_slots(), kNoConstraint);
  std::vector<bool> is_renewed(sides_.size(), false);
  const auto forget = [&](TetId t) {
    sides_[t.index()] = kNoConstraint;
    is_renewed[t.index()] = true;
  };
  for (const TetId t : exchanged.renewed) {
    forget(t);
    if (!delaunay.is_live(t) || delaunay.is_ghost(t)) continue;
    // The constraints of a ghost came from the tetrahedron in front of it.
    for (unsigned face = 0; face < 4; ++face) {
      if (delaunay.is_ghost(delaunay.neighbour(t, face))) forget(delaunay.neighbour(t, face));
    }
  }
  for (Trace& trace : traces_) {
    if (std::any_of(trace.tets.begin(), trace.tets.end(), [&](TetId t) { return is_renewed[t.index()]; })) {
      trace.is_stale = true;
    }
  }
}

void SignConstraints::update(const CellLevels& cell_levels, int threads) {
  sides_.resize(restricted_.delaunay().tet_slots(), kNoConstraint);
  // Refined cells stay refined.
  std::vector<Trace> traces;
  traces.reserve(cell_levels.levels().size());
  std::vector<std::size_t> stale;
  auto old = traces_.begin();
  for (const auto& [name, level] : cell_levels.levels()) {
    if (old != traces_.end() && old->cell == name) {
      traces.push_back(std::move(*old++));
    } else {
      traces.push_back({name, {}, true});
    }
    if (traces.back().is_stale) stale.push_back(traces.size() - 1);
  }
  traces_ = std::move(traces);

  // Constraints that a cell notes again in unchanged tetrahedra are the same as before.
  for_each_block(
      stale.size(), threads,
      [&](std::size_t first, std::size_t last) {
        Collector collector(restricted_, sides_);
        for (std::size_t i = first; i < last; ++i) {
          Trace& trace = traces_[stale[i]];
          trace.tets = collector.collect(cell_levels.cell(trace.cell), trace.tets);
          trace.is_stale = false;
        }
      },
      kCellsAtOnce);
}

}  // namespace deliso
