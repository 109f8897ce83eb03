#include "surface/repair/lattice/samples.h"

#include <algorithm>
#include <array>
#include <set>

namespace deliso {

namespace {

// Samples are exchanged in the present triangulation when they are fewer than all divided by this.
constexpr std::size_t kExchangeShare = 4;

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
                                     const Isosurface& isosurface) const {
  Resampling resampling;
  std::vector<std::uint64_t> have;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const RepairSample& sample = samples_[i];
    if (sample.key != 0) {
      have.push_back(sample.key);
    } else if (cell_levels.is_refined(cell_levels.name(cell_levels.cell_of(sample.point))) &&
               !SignedDelaunay::on_box(isosurface.box(), sample.point)) {
      resampling.leaving.push_back(VertexId(i));
    }
  }
  std::sort(have.begin(), have.end());
  std::vector<LatticeSample> found;
  for (const auto& [name, level] : cell_levels.levels()) lattice.append(cell_levels.cell(name), level, found);
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  std::uint64_t last = 0;
  for (const LatticeSample& sample : found) {
    if (sample.key == last || std::binary_search(have.begin(), have.end(), sample.key)) continue;
    last = sample.key;
    resampling.coming.push_back({scaled(sample.point, isosurface.step()), sample.key});
  }
  return resampling;
}

bool RepairSamples::changes_few(const Resampling& resampling) const {
  return resampling.leaving.size() + resampling.coming.size() < samples_.size() / kExchangeShare;
}

// A lattice sample that equals a vertex is not stored: if that vertex is removed, the lattice sample comes again.
void RepairSamples::exchange(const Resampling& resampling, std::span<const VertexId> vertex_of) {
  remove(resampling.leaving);
  for (std::size_t i = 0; i < resampling.coming.size(); ++i) {
    if (vertex_of[i] == VertexId(samples_.size())) samples_.push_back(resampling.coming[i]);
  }
}

void RepairSamples::replace(const Resampling& resampling) {
  remove(resampling.leaving);
  samples_.insert(samples_.end(), resampling.coming.begin(), resampling.coming.end());
}

void RepairSamples::take_vertices(std::span<const VertexId> vertex_of) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (vertex_of[i] == VertexId(kept)) samples_[kept++] = samples_[i];
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
