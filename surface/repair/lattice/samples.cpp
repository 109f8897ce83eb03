#include "surface/repair/lattice/samples.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_set>
#include <utility>

#include "delaunay/spatial_order.h"

namespace deliso {

namespace {

// Samples are exchanged in the present triangulation when they are fewer than this share of all.
constexpr double kExchangeShare = 0.4;

std::vector<Vec3> points_of(std::span<const RepairSample> samples) {
  std::vector<Vec3> points;
  points.reserve(samples.size());
  for (const RepairSample& sample : samples) points.push_back(sample.point);
  return points;
}

}  // namespace

std::vector<Vec3> Resampling::coming_points() const { return points_of(coming); }

RepairSamples::RepairSamples(const SignedDelaunay& restricted, std::span<const Vec3> fixed) {
  const auto key_of = [](const Vec3& p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  std::set<std::array<double, 3>> stays;
  for (const Vec3& p : fixed) stays.insert(key_of(p));
  const auto& points = restricted.delaunay().points();
  samples_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!restricted.is_virtual(VertexId(i)))
      samples_.push_back({points[i], stays.contains(key_of(points[i])) ? kStays : 0});
  }
}

std::vector<Vec3> RepairSamples::points() const { return points_of(samples_); }

Resampling RepairSamples::resampling(const CellLevels& cell_levels, const SampleLattice& lattice,
                                     const Isosurface& isosurface) {
  const std::vector<std::pair<CellName, int>> changed = changed_cells(cell_levels);
  std::unordered_set<CellName> refined;
  for (const auto& [cell, level_before] : changed) {
    if (level_before == 0) refined.insert(cell);
  }
  Resampling resampling;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const RepairSample& sample = samples_[i];
    if (sample.key == 0 && refined.contains(cell_levels.name(cell_levels.cell_of(sample.point))) &&
        !SignedDelaunay::on_box(isosurface.box(), sample.point)) {
      resampling.leaving.push_back(VertexId(i));
    }
  }
  std::vector<RepairSample> coming = new_samples(cell_levels, lattice, changed, isosurface.step());
  coming.insert(coming.end(), hidden_.begin(), hidden_.end());
  hidden_.clear();
  // In an order in which the next one is near: each is sought from the one before it.
  for (const std::uint32_t i : spatial_order(points_of(coming))) resampling.coming.push_back(coming[i]);
  return resampling;
}

std::vector<std::pair<CellName, int>> RepairSamples::changed_cells(const CellLevels& cell_levels) {
  std::vector<std::pair<CellName, int>> changed;
  auto before = sampled_.begin();
  for (const auto& [cell, level] : cell_levels.levels()) {
    // Refined cells stay refined.
    const bool is_known = before != sampled_.end() && before->first == cell;
    const int level_before = is_known ? (before++)->second : 0;
    if (level_before != level) changed.emplace_back(cell, level_before);
  }
  sampled_.assign(cell_levels.levels().begin(), cell_levels.levels().end());
  return changed;
}

std::vector<RepairSample> RepairSamples::new_samples(const CellLevels& cell_levels, const SampleLattice& lattice,
                                                     std::span<const std::pair<CellName, int>> cells,
                                                     const Vec3& step) {
  std::vector<LatticeSample> found;
  for (const auto& [cell, level_before] : cells)
    lattice.append(cell_levels.cell(cell), cell_levels.levels().at(cell), found);
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  std::vector<RepairSample> samples;
  const auto known = static_cast<std::ptrdiff_t>(keys_.size());
  for (const LatticeSample& sample : found) {
    if (std::binary_search(keys_.begin(), keys_.begin() + known, sample.key)) continue;
    if (!samples.empty() && samples.back().key == sample.key) continue;
    keys_.push_back(sample.key);
    samples.push_back({scaled(sample.point, step), sample.key});
  }
  std::inplace_merge(keys_.begin(), keys_.begin() + known, keys_.end());
  return samples;
}

bool RepairSamples::changes_few(const Resampling& resampling) const {
  const std::size_t changes = resampling.leaving.size() + resampling.coming.size();
  return static_cast<double>(changes) < kExchangeShare * static_cast<double>(samples_.size());
}

void RepairSamples::exchange(const Resampling& resampling, std::span<const VertexId> vertex_of) {
  remove(resampling.leaving);
  for (std::size_t i = 0; i < resampling.coming.size(); ++i) {
    (vertex_of[i] == VertexId(samples_.size()) ? samples_ : hidden_).push_back(resampling.coming[i]);
  }
}

void RepairSamples::replace(const Resampling& resampling) {
  remove(resampling.leaving);
  samples_.insert(samples_.end(), resampling.coming.begin(), resampling.coming.end());
}

void RepairSamples::take_vertices(std::span<const VertexId> vertex_of) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (vertex_of[i] == VertexId(kept)) {
      samples_[kept++] = samples_[i];
    } else if (samples_[i].key != 0 && samples_[i].key != kStays) {
      hidden_.push_back(samples_[i]);
    }
  }
  samples_.resize(kept);
}

void RepairSamples::remove(std::span<const VertexId> leaving) {
  std::size_t kept = 0;
  for (std::size_t i = 0, gone = 0; i < samples_.size(); ++i) {
    if (gone < leaving.size() && leaving[gone] == VertexId(i)) {
      ++gone;
    } else {
      samples_[kept++] = samples_[i];
    }
  }
  samples_.resize(kept);
}

}  // namespace deliso
