#include "surface/recover/coverage.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/recover/recover.h"
#include "surface/restricted/signs_from_facets.h"
#include "surface/search/coverage_query.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

constexpr int kRounds = 4;               // of searches for parts that the mesh misses
constexpr std::size_t kFewSuspects = 4;  // few suspects: fewer than the triangles divided by this
// Crossings are queried brick by brick, with this many samples along each side of a brick.
constexpr std::int32_t kBrick = 8;

// Drops the crossings that some triangle covers.
void drop_covered(std::vector<std::uint32_t>& crossings, const std::vector<Vec3>& points, const SurfaceMesh& mesh,
                  int threads) {
  const auto any = [](std::uint32_t) { return true; };
  const std::vector<std::uint32_t> covering = covering_triangles(points, mesh, any, threads);
  std::size_t left = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (covering[i] == kNoTriangle) crossings[left++] = crossings[i];
  }
  crossings.resize(left);
}

}  // namespace

std::vector<std::uint32_t> all_crossings(const ExactSurface& surface) {
  const ScalarGrid& grid = surface.grid();
  const auto& all = surface.topology.crossings;
  std::array<std::size_t, 3> bricks{};  // along each axis
  for (std::size_t axis = 0; axis < 3; ++axis) bricks[axis] = static_cast<std::size_t>(grid.dims()[axis] / kBrick) + 1;
  std::vector<std::uint32_t> brick_of(all.size());
  const auto brick = [](std::int32_t place) { return static_cast<std::size_t>(place / kBrick); };
  for_each_block(all.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    // Crossings come row by row of samples, so the brick row is computed once per row.
    const auto length = static_cast<std::uint64_t>(grid.dims()[0]);
    std::uint64_t row = 0, row_end = 0;  // the row's first sample, and the end of its samples
    std::size_t row_brick = 0;           // the row's first brick
    for (std::size_t i = first; i < last; ++i) {
      const std::uint64_t sample = all[i].sample;
      if (sample >= row_end) {
        const CellIndex at = sample_of(all[i], grid.dims());
        row = sample - static_cast<std::uint64_t>(at[0]);
        row_end = row + length;
        row_brick = bricks[0] * (brick(at[1]) + bricks[1] * brick(at[2]));
      }
      brick_of[i] = static_cast<std::uint32_t>((sample - row) / kBrick + row_brick);
    }
  });
  // A counting sort by brick, which keeps the order within a brick.
  std::vector<std::uint32_t> next(bricks[0] * bricks[1] * bricks[2] + 1, 0);  // index of each brick's next crossing
  for (const std::uint32_t own : brick_of) ++next[own + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> crossings(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) crossings[next[brick_of[i]]++] = i;
  return crossings;
}

std::vector<Vec3> uncovered_points(const RestrictedDelaunay& restricted, const ExactSurface& surface,
                                   std::vector<std::uint32_t>& suspects, std::vector<Vec3>* coverage_targets) {
  const int threads = surface.threads;
  // Restricted facets as they are; they need not form a manifold here.
  const SurfaceMesh mesh = facets_alone(restricted, threads);
  const auto position = [&](std::uint32_t crossing) { return surface.position(surface.topology.crossings[crossing]); };
  const auto positions = [&](std::span<const std::uint32_t> crossings) {
    std::vector<Vec3> points;
    points.reserve(crossings.size());
    for (const std::uint32_t crossing : crossings) points.push_back(position(crossing));
    return points;
  };
  // If there are few suspects, most have a triangle near by now. Then the covered ones are dropped first, because a
  // tree of all triangles is worth its cost only for the others.
  const bool are_few = suspects.size() <= mesh.triangles.size() / kFewSuspects;
  if (coverage_targets == nullptr && are_few) drop_covered(suspects, positions(suspects), mesh, threads);
  if (suspects.empty()) return {};
  const CoverageQuery cover(mesh, threads);
  const std::vector<std::uint32_t> asked = std::move(suspects);
  std::vector<CoverageQuery::Cover> covers(asked.size());
  for_each_block(asked.size(), threads, [&](std::size_t first, std::size_t last) {
    const std::vector<Vec3> points = positions(std::span(asked).subspan(first, last - first));
    cover.look_at_all(points, std::span(covers).subspan(first, last - first));
  });
  suspects.clear();
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (covers[i] == CoverageQuery::Cover::kNone) suspects.push_back(asked[i]);
    if (coverage_targets != nullptr && covers[i] != CoverageQuery::Cover::kClose)
      coverage_targets->push_back(position(asked[i]));
  }
  return positions(suspects);
}

std::vector<Vec3> recover_missed_parts(RestrictedDelaunay& restricted, const ExactSurface& surface,
                                       const RecoverOptions& options, bool wants_targets, Controls& controls,
                                       RecoverStats& stats) {
  std::vector<Vec3> targets;
  if (controls.stopped()) return targets;
  std::vector<std::uint32_t> suspects = all_crossings(surface);
  for (int i = 0; i < kRounds; ++i) {
    const std::vector<Vec3> points =
        uncovered_points(restricted, surface, suspects, i == 0 && wants_targets ? &targets : nullptr);
    if (recover_with(restricted, points, options, controls, stats) == 0 || controls.poll()) break;
  }
  targets.shrink_to_fit();
  return targets;
}

}  // namespace deliso
