#include "surface/sizes/decimation.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"
#include "surface/shape/box_set.h"
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
        counters_(static_cast<std::size_t>(std::max(surface.threads, 1))),
        is_queued_(mesh.points.size(), 0) {
    for (SearchCounters& counters : counters_) {
      searches_.emplace_back(patch_, witnesses_, surface.isosurface, options_, counters);
    }
  }

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
  // The best collapse of a vertex as the mesh is now, if there is one.
  struct Found {
    Queued queued;
    std::optional<double> error = {};
    double cost = 0;
    PatchStep step = {};
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
  void take_batch();
  void search_batch();
  std::size_t remove_batch(std::size_t left);
  void remove(const Found& found);
  [[nodiscard]] Box3 box_around(std::uint32_t vertex) const;

  DecimationOptions options_;
  DecimationStats& stats_;
  Patch patch_;
  Witnesses witnesses_;
  const ExactSurface& surface_;
  std::vector<SearchCounters> counters_;  // of each search
  std::vector<CollapseSearch> searches_;  // one for each thread
  std::priority_queue<Queued> queue_;
  std::vector<Found> batch_;
  double next_cost_ = 0;  // in the queue, of what comes after the batch
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

// The cheapest first, many at once: those that lie apart do not change what is found for each other. The same for any
// number of threads.
void Decimation::run(Controls& controls) {
  std::size_t left = 0;
  for (std::uint32_t v = 0; v < patch_.vertex_count(); ++v) left += patch_.star(v).empty() ? 0 : 1;
  if (left <= options_.enough) return;
  queue_all();
  while (!queue_.empty() && left > options_.enough && !controls.poll()) {
    controls.report("decimate", left, queue_.size());
    take_batch();
    search_batch();
    left = remove_batch(left);
  }
  for (const SearchCounters& some : counters_) stats_.search += some;
}

// All triangles that a collapse removes or adds lie in it, and what it depends on meets it.
Box3 Decimation::box_around(std::uint32_t vertex) const {
  Box3 box;
  for (const std::uint32_t t : patch_.star(vertex)) {
    for (const Vec3& p : patch_.corner_points(t)) box.extend(p);
  }
  return box;
}

// A share of the queue: with a larger one more vertices would go before others that cost less once what is around them
// has changed.
void Decimation::take_batch() {
  constexpr std::size_t kShare = 64, kFewest = 16, kMost = 4096;
  const std::size_t most = std::clamp(queue_.size() / kShare, kFewest, kMost);
  batch_.clear();
  BoxSet taken;
  std::vector<std::uint32_t> near;
  std::vector<Queued> later;
  while (!queue_.empty() && batch_.size() < most && later.size() < most) {
    const Queued next = queue_.top();
    queue_.pop();
    is_queued_[next.vertex] = 0;
    if (patch_.star(next.vertex).empty()) continue;
    const Box3 box = box_around(next.vertex);
    bool is_apart = true;
    taken.for_each_meeting(box, near, [&](std::uint32_t) { is_apart = false; });
    if (!is_apart) {
      later.push_back(next);
      continue;
    }
    taken.add(box);
    batch_.push_back({next});
  }
  next_cost_ = queue_.empty() ? std::numeric_limits<double>::infinity() : queue_.top().cost;
  for (const Queued& next : later) queue(next.vertex, next.cost);
}

void Decimation::search_batch() {
  run_tasks(searches_.size(), surface_.threads, [&](std::size_t task) {
    CollapseSearch& search = searches_[task];
    for (std::size_t i = task; i < batch_.size(); i += searches_.size()) {
      Found& found = batch_[i];
      found.error = search.find(found.queued.vertex, true);
      if (!found.error) continue;
      found.cost = cost_of(*found.error, search.mean_edge());
      found.step = search.step();
    }
  });
}

// Returns how many vertices are left.
std::size_t Decimation::remove_batch(std::size_t left) {
  for (const Found& found : batch_) {
    if (left <= options_.enough) break;
    if (!found.error) continue;
    if (found.cost > found.queued.cost && found.cost > next_cost_) {
      queue(found.queued.vertex, found.cost);
      continue;
    }
    // Of one small component the batch may have several.
    if (!searches_.front().keeps_volume(found.step, found.queued.vertex)) continue;
    remove(found);
    --left;
  }
  return left;
}

void Decimation::remove(const Found& found) {
  const auto first_added = static_cast<std::uint32_t>(patch_.triangle_count());
  patch_.apply(found.step);
  witnesses_.pass_on(found.step.removed, found.queued.vertex, first_added, patch_);
  stats_.largest_error = std::max(stats_.largest_error, *found.error);
  // Vertices that had to stay may go now.
  const double cost = queue_.empty() ? *found.error : std::max(*found.error, queue_.top().cost);
  for (const auto& corners : found.step.added) {
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
