#include "experiments/lesson/lesson_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "volume/topology/cell_sweep.h"

namespace deliso {
namespace {

constexpr std::size_t kMostCells = 4;
// Events of a cell that is shown lie so far apart, and from its bottom and top.
constexpr double kLeastGap = 0.02;
constexpr std::size_t kMostSearchedCells = 40'000;

struct SweepEvent {
  double w = 0;
  std::string kind;
  double u = 0, v = 0;
};

// Corners of the slice at height w.
std::array<double, 4> slice_of(const CellCorners& corners, double w) {
  std::array<double, 4> slice{};
  for (std::size_t c = 0; c < 4; ++c) slice[c] = (1 - w) * corners[c] + w * corners[c + 4];
  return slice;
}

// Half of the sign changes around a slice.
int arcs_in(const std::array<double, 4>& f) {
  const auto differ = [&](std::size_t a, std::size_t b) { return (f[a] < 0) != (f[b] < 0) ? 1 : 0; };
  return (differ(0, 1) + differ(1, 3) + differ(3, 2) + differ(2, 0)) / 2;
}

// Corners change sign, and saddles as the sweep has found them; by height.
std::vector<SweepEvent> events_of(const CellCorners& corners, const CellSweep& sweep) {
  std::vector<SweepEvent> events;
  for (std::size_t c = 0; c < 4; ++c) {
    const double low = corners[c], high = corners[c + 4];
    if ((low < 0) == (high < 0)) continue;
    events.push_back({low / (low - high), "", static_cast<double>(c & 1u), static_cast<double>(c >> 1u)});
  }
  for (int i = 0; i < sweep.saddle_count(); ++i) {
    const Vec3& p = sweep.saddle(i).uvw;
    events.push_back({p.z, "saddle", p.x, p.y});
  }
  std::sort(events.begin(), events.end(), [](const SweepEvent& a, const SweepEvent& b) { return a.w < b.w; });
  return events;
}

bool are_apart(const std::vector<SweepEvent>& events) {
  double before = 0;
  for (const SweepEvent& event : events) {
    if (event.w - before < kLeastGap) return false;
    before = event.w;
  }
  return 1 - before >= kLeastGap;
}

// The part of the cell below a height is a trilinear cell of its own.
Json counted_below(const CellCorners& corners, double w) {
  CellCorners part = corners;
  const std::array<double, 4> top = slice_of(corners, w);
  std::copy(top.begin(), top.end(), part.begin() + 4);
  const CellSweep sweep(part, 0);
  int chi = 0;
  for (int piece = 0; piece < sweep.pieces(); ++piece) chi += sweep.euler_characteristic(piece);
  return {{"pieces", sweep.pieces()}, {"chi", chi}, {"arcs", arcs_in(top)}};
}

Json cell_json(const std::array<std::int32_t, 3>& cell, const CellCorners& corners, const CellSweep& sweep,
               std::vector<SweepEvent> events) {
  Json json = {{"cell", cell}, {"values", corners}, {"events", Json::array()}, {"below", Json::array()}};
  json["pieces"] = Json::array();
  for (int piece = 0; piece < sweep.pieces(); ++piece) json["pieces"].push_back(sweep.euler_characteristic(piece));
  for (std::size_t i = 0; i <= events.size(); ++i) {
    const double from = i == 0 ? 0 : events[i - 1].w, to = i == events.size() ? 1 : events[i].w;
    json["below"].push_back(counted_below(corners, (from + to) / 2));
    if (i == 0) continue;
    SweepEvent& event = events[i - 1];
    const int before = json["below"][i - 1]["arcs"], after = json["below"][i]["arcs"];
    if (event.kind.empty()) event.kind = after > before ? "appear" : after < before ? "vanish" : "move";
    json["events"].push_back({{"w", event.w}, {"kind", event.kind}, {"u", event.u}, {"v", event.v}});
  }
  return json;
}

// Saddles first, then pieces of other kinds than disks, then events.
std::array<int, 3> interest_of(const CellSweep& sweep, std::size_t events) {
  int others = 0;
  for (int piece = 0; piece < sweep.pieces(); ++piece) others += sweep.euler_characteristic(piece) == 1 ? 0 : 1;
  return {others, sweep.saddle_count() + sweep.pieces(), static_cast<int>(events)};
}

}  // namespace

Json lesson_cells(const ScalarGrid& grid, double isovalue) {
  const auto [nx, ny, nz] = grid.dims();
  std::vector<std::pair<std::array<int, 3>, Json>> found;
  std::size_t searched = 0;
  for (std::int32_t k = 0; k + 1 < nz; ++k) {
    for (std::int32_t j = 0; j + 1 < ny; ++j) {
      for (std::int32_t i = 0; i + 1 < nx; ++i) {
        CellCorners corners = grid.cell(i, j, k);
        for (double& value : corners) value -= isovalue;
        if (is_simple(sign_pattern(corners, 0)) || ++searched > kMostSearchedCells) continue;
        const CellSweep sweep(corners, 0);
        std::vector<SweepEvent> events = events_of(corners, sweep);
        if (sweep.singular_inside() || sweep.saddle_faces() != 0 || !are_apart(events)) continue;
        const auto interest = interest_of(sweep, events.size());
        found.emplace_back(interest, cell_json({i, j, k}, corners, sweep, std::move(events)));
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Json cells = Json::array();
  std::set<std::array<int, 3>> kinds;
  for (auto& [interest, cell] : found) {
    if (cells.size() < kMostCells && kinds.insert(interest).second) cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace deliso
