#include "surface/sizes/decimation.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "surface/base/parallel_blocks.h"
#include "surface/shape/patch.h"
#include "surface/shape/patches.h"
#include "surface/sizes/collapse_search.h"
#include "surface/sizes/witnesses.h"

namespace deliso {

namespace {

constexpr std::size_t kVerticesAtOnce = 1024;

Patch patch_of(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  Patch patch(mean_edge(mesh, all));
  for (const Vec3& p : mesh.points) patch.add_vertex(p);
  for (const auto& corners : mesh.triangles) patch.add_triangle(corners);
  return patch;
}

SurfaceMesh mesh_of(const Patch& patch) {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> number(patch.vertex_count());
  for (std::uint32_t v = 0; v < patch.vertex_count(); ++v) {
    if (patch.star(v).empty()) continue;
    number[v] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(patch.point(v));
  }
  for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) {
    if (!patch.has(t)) continue;
    const auto& [a, b, c] = patch.corners(t);
    mesh.triangles.push_back({number[a], number[b], number[c]});
  }
  return mesh;
}

class Decimation {
 public:
  Decimation(const SurfaceMesh& mesh, const ExactSurface& surface, const DecimationOptions& options,
             DecimationStats& stats)
      : options_(options),
        stats_(stats),
        patch_(patch_of(mesh)),
        witnesses_(patch_, surface, options.max_error, options.witnesses),
        surface_(surface),
        search_(patch_, witnesses_, surface.isosurface, options_, stats.search),
        is_queued_(mesh.points.size(), 0) {}

  void run(Controls& controls);
  [[nodiscard]] SurfaceMesh mesh() const { return mesh_of(patch_); }

 private:
  struct Queued {
    double cost;
    std::uint32_t vertex;
    friend bool operator<(const Queued& a, const Queued& b) {
      return a.cost != b.cost ? a.cost > b.cost : a.vertex > b.vertex;
    }
  };
  // What decides the order: the error, and among those that cost next to nothing the crowded ones first.
  static double cost_of(double error, double mean_edge) {
    constexpr double kPerLength = 2e-3;
    return error + kPerLength * mean_edge;
  }
  void queue_all();
  void queue(std::uint32_t vertex, double cost) {
    is_queued_[vertex] = 1;
    queue_.push({cost, vertex});
  }
  void remove(std::uint32_t vertex, double error);

  DecimationOptions options_;
  DecimationStats& stats_;
  Patch patch_;
  Witnesses witnesses_;
  const ExactSurface& surface_;
  CollapseSearch search_;
  std::priority_queue<Queued> queue_;
  std::vector<std::uint8_t> is_queued_;
};

void Decimation::queue_all() {
  std::vector<Queued> found(patch_.vertex_count());
  std::vector<std::uint8_t> is_found(found.size(), 0);
  std::vector<SearchCounters> counters(found.size() / kVerticesAtOnce + 1);
  for_each_block(
      found.size(), surface_.threads,
      [&](std::size_t first, std::size_t last) {
        CollapseSearch search(patch_, witnesses_, surface_.isosurface, options_, counters[first / kVerticesAtOnce]);
        for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) {
          const std::optional<double> error = search.find(v, false);
          if (!error) continue;
          is_found[v] = 1;
          found[v] = {cost_of(*error, search.mean_edge()), v};
        }
      },
      kVerticesAtOnce);
  for (const SearchCounters& some : counters) stats_.search += some;
  for (std::size_t v = 0; v < found.size(); ++v) {
    if (is_found[v] != 0) queue(found[v].vertex, found[v].cost);
  }
}

void Decimation::run(Controls& controls) {
  std::size_t left = 0;
  for (std::uint32_t v = 0; v < patch_.vertex_count(); ++v) left += patch_.star(v).empty() ? 0 : 1;
  if (left <= options_.enough) return;
  queue_all();
  std::uint32_t turn = 0;
  while (!queue_.empty() && left > options_.enough) {
    if ((turn++ & 255U) == 0) {
      if (controls.poll()) return;
      controls.report("decimate", left, queue_.size());
    }
    const Queued next = queue_.top();
    queue_.pop();
    is_queued_[next.vertex] = 0;
    if (patch_.star(next.vertex).empty()) continue;
    // What is around it may have changed since.
    const std::optional<double> error = search_.find(next.vertex, true);
    if (!error) continue;
    const double cost = cost_of(*error, search_.mean_edge());
    if (cost > next.cost && !queue_.empty() && cost > queue_.top().cost) {
      queue(next.vertex, cost);
      continue;
    }
    remove(next.vertex, *error);
    --left;
  }
}

void Decimation::remove(std::uint32_t vertex, double error) {
  const PatchStep& step = search_.step();
  const auto first_added = static_cast<std::uint32_t>(patch_.triangle_count());
  patch_.apply(step);
  witnesses_.pass_on(step.removed, vertex, first_added, patch_);
  stats_.largest_error = std::max(stats_.largest_error, error);
  // Vertices that had to stay may go now.
  const double cost = queue_.empty() ? error : std::max(error, queue_.top().cost);
  for (const auto& corners : step.added) {
    for (const std::uint32_t v : corners) {
      if (is_queued_[v] == 0) queue(v, cost);
    }
  }
}

}  // namespace

void decimate(SurfaceMesh& mesh, const ExactSurface& surface, const DecimationOptions& options, Controls& controls,
              DecimationStats& stats) {
  if (stats.vertices_before == 0) stats.vertices_before = static_cast<std::int64_t>(mesh.points.size());
  if (!controls.poll()) {
    Decimation decimation(mesh, surface, options, stats);
    decimation.run(controls);
    mesh = decimation.mesh();
  }
  stats.vertices_after = static_cast<std::int64_t>(mesh.points.size());
}

}  // namespace deliso
