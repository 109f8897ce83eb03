// One pass of stage 2 over a mesh or a part of it (Dey and Levine, section 3.2): queue, disk, star, criteria.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/base/bucket_queue.h"
#include "surface/refine/disk/refinement_candidates.h"
#include "surface/refine/disk/refinement_disk.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/guard/crossing_guard.h"
#include "surface/refine/refine.h"
#include "surface/refine/slabs/refinement_slabs.h"

namespace deliso {

// What a refinement did to a mesh.
struct RefinementChange {
  std::vector<std::uint32_t> places;
  std::vector<RefinementMesh::Triangle> triangles;  // at these places
  std::vector<RefinementMesh::Triangle> new_triangles;
  std::vector<RefinementMesh::Vertex> new_vertices;

  // Does it again to the mesh as it was.
  void redo(RefinementMesh& mesh) const;
};

class RefineLoop {
 public:
  // Of a mesh whose vertices have clearances.
  RefineLoop(RefinementPart& part, const Isosurface& isosurface, const RefineOptions& options, RefineStats& stats)
      : part_(part),
        mesh_(part.mesh),
        isosurface_(isosurface),
        options_(options),
        criteria_(criteria_of(options)),
        stats_(stats),
        disk_(part.mesh, part.frozen) {}

  // Finds the balls of all triangles and which are coarse; returns an estimate of the insertions that each will need.
  std::vector<float> measure_all(int threads);
  // Refines the coarse triangles, as far as the part allows. Threads prepare it; it runs on this one alone.
  void run(Controls& controls, int threads);
  // Takes back all that run() did, but for what it found suspect; returns what that was.
  RefinementChange take_back();

 private:
  using Candidate = RefinementCandidate;
  // A triangle to be, with its ball and what the criteria say.
  struct NewTriangle {
    SurfaceDelaunayBall ball;
    bool has_hit = false;
    double badness = 0;
    double radius = 0;
    double squared_longest = 0;  // of its longest edge
  };

  [[nodiscard]] bool is_wanted(std::uint32_t triangle) const;
  void queue_coarse_triangles();
  void refine_queued(Controls& controls);
  bool insert_coverage_targets(Controls& controls, int threads);
  bool treat(std::uint32_t triangle);
  std::optional<Refusal> insert(const Candidate& candidate, TriangleSide* encroached_edge);
  [[nodiscard]] std::optional<Refusal> plan_star(const Candidate& candidate);
  [[nodiscard]] Vec3 upwards(const Candidate& candidate) const;
  void replace_disk(const Candidate& candidate);
  void wake_neighbours();
  bool retry_crossed();
  void requeue(std::uint32_t triangle);
  void learn(std::uint32_t triangle, const NewTriangle& measured);
  void queue(std::uint32_t triangle, const NewTriangle& measured);

  // What is measured of a triangle.
  struct Shape {
    std::array<Vec3, 3> corners;
    double mean_pole = 0;
  };
  [[nodiscard]] NewTriangle measure(const Shape& shape);
  void measure(std::span<const Shape> shapes, std::span<NewTriangle> measured);
  [[nodiscard]] NewTriangle measured(std::uint32_t triangle);
  [[nodiscard]] double mean_pole_height(std::uint32_t triangle) const;
  [[nodiscard]] double inherited_pole_height(const Vec3& p, bool closed) const;
  // B_sigma as it is kept; or found anew, the same to the last bit.
  [[nodiscard]] SurfaceDelaunayBall ball_of(std::uint32_t triangle) {
    if (options_.store_hits) return mesh_.triangles[triangle].ball;
    return measure({mesh_.corner_points(mesh_.triangles[triangle].corners), 1}).ball;
  }

  RefinementPart& part_;
  RefinementMesh& mesh_;
  const Isosurface& isosurface_;
  const RefineOptions& options_;
  Criteria criteria_;
  RefineStats& stats_;
  BucketQueue queue_;
  RefinementDisk disk_;                 // E
  std::optional<CrossingGuard> guard_;  // while it runs
  std::vector<Shape> shapes_;           // D, one for each edge of E's rim,
  std::vector<NewTriangle> star_;       // and what is measured of it
  std::vector<std::uint32_t> slots_;    // the places of the star's triangles
  std::vector<std::uint32_t> crossed_;  // triangles whose refinement a crossing prevented
  // What is changed: each triangle as it was at the start, and how many vertices there were.
  class Start {
   public:
    explicit Start(const RefinementMesh& mesh)
        : is_kept_(mesh.triangles.size(), false), vertex_count_(mesh.vertices.size()) {}
    void keep(std::uint32_t t, const RefinementMesh& mesh);
    RefinementChange restore(RefinementMesh& mesh);

   private:
    std::vector<std::uint32_t> places_;
    std::vector<RefinementMesh::Triangle> triangles_;  // as they were at these places
    std::vector<bool> is_kept_;                        // of each triangle of the start
    std::size_t vertex_count_;
  };
  std::optional<Start> start_;
  double star_pole_height_ = 0;
  bool is_blocked_ = false;  // the latest attempt leaves the part: refused for now, another part decides
  std::int64_t insertions_at_retry_ = 0;
};

}  // namespace deliso
