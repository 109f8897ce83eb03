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

// A vertex of the start, where it is or was.
struct MovedVertex {
  std::uint32_t vertex = 0;
  Vec3 point;
  float clearance = 0;
};

// The changes that a refinement made to a mesh.
struct RefinementChange {
  std::vector<std::uint32_t> places;
  std::vector<RefinementMesh::Triangle> triangles;  // of these slots
  std::vector<MovedVertex> moved;
  std::vector<RefinementMesh::Triangle> new_triangles;
  std::vector<RefinementMesh::Vertex> new_vertices;

  // Applies the changes again to the mesh as it was before.
  void redo(RefinementMesh& mesh) const;
};

class RefineLoop {
 public:
  // For a mesh whose vertices have clearances.
  RefineLoop(RefinementPart& part, const Isosurface& isosurface, const RefineOptions& options, RefineStats& stats)
      : part_(part),
        mesh_(part.mesh),
        isosurface_(isosurface),
        options_(options),
        criteria_(criteria_of(options)),
        stats_(stats),
        disk_(part.mesh, part.frozen) {}

  // Finds the balls of all triangles and which triangles are coarse; returns an estimate of the insertions that each
  // needs.
  std::vector<float> measure_all(int threads);
  // Refines the coarse triangles as far as the part allows. Only the preparation uses several threads.
  void run(Controls& controls, int threads);
  // Takes back all changes of run(), except which vertices are suspect; returns the changes.
  RefinementChange take_back();

 private:
  using Candidate = RefinementCandidate;
  // A planned triangle, with its ball and the result of the criteria.
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
  std::optional<Refusal> insert(Candidate candidate, TriangleSide* encroached_edge);
  [[nodiscard]] std::optional<Refusal> refusal_of_star(const Candidate& candidate, const Vec3& gradient);
  [[nodiscard]] std::optional<Refusal> plan_star(const Candidate& candidate, const Vec3& gradient);
  [[nodiscard]] Vec3 upwards(const Candidate& candidate) const;
  void replace_disk(const Candidate& candidate);
  void wake_neighbours();
  bool retry_crossed();
  struct FlippedEdge;
  bool flip_edges(Controls& controls, int threads);
  [[nodiscard]] std::optional<FlippedEdge> flipped_edge(std::uint32_t triangle, unsigned side) const;
  [[nodiscard]] bool is_edge(std::uint32_t triangle, unsigned corner, std::uint32_t other) const;
  [[nodiscard]] double height_at_middle(const Vec3& a, const Vec3& b, const Vec3& direction);
  [[nodiscard]] bool improves(const FlippedEdge& edge);
  void flip(const FlippedEdge& edge);
  // Squared sines of the smallest angles of a star's triangles.
  struct StarAngles {
    double least = 1, sum = 0;
  };
  void smooth_vertices(Controls& controls, int threads);
  [[nodiscard]] bool is_fine(std::span<const std::uint32_t> triangles) const;
  [[nodiscard]] StarAngles angles_around(const Vec3& p) const;
  bool smooth(std::uint32_t v);
  [[nodiscard]] bool may_move(std::uint32_t v, const Vec3& to, double reach);
  void move_vertex(std::uint32_t v, const Vec3& to);
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
  [[nodiscard]] double inherited_pole_height(bool closed) const;
  // B_sigma: stored, or else searched again with the same result bit for bit.
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
  std::vector<double> distances_;       // squared, of the rim's vertices from the point, in order
  std::vector<Shape> shapes_;           // D, one for each edge of E's rim,
  std::vector<NewTriangle> star_;       // and what is measured of it
  std::vector<std::uint32_t> slots_;    // the slots of the star's triangles
  std::vector<std::uint32_t> crossed_;  // triangles whose refinement a crossing prevented
  // The state at the start: each changed triangle and moved vertex as it was, and the number of vertices.
  class Start {
   public:
    explicit Start(const RefinementMesh& mesh)
        : is_kept_(mesh.triangles.size(), false), vertex_count_(mesh.vertices.size()) {}
    void keep(std::uint32_t t, const RefinementMesh& mesh);
    void keep_vertex(std::uint32_t v, const RefinementMesh& mesh);
    RefinementChange restore(RefinementMesh& mesh);

   private:
    std::vector<std::uint32_t> places_;
    std::vector<RefinementMesh::Triangle> triangles_;  // as they were in these slots
    std::vector<MovedVertex> moved_;                   // where they were
    std::vector<bool> is_moved_;                       // of each vertex of the start, once one is moved
    std::vector<bool> is_kept_;                        // of each triangle of the start
    std::size_t vertex_count_;
  };
  std::optional<Start> start_;
  double star_pole_height_ = 0;
  bool is_blocked_ = false;  // the latest attempt would leave the part: it is refused for now, and another part decides
  std::int64_t insertions_at_retry_ = 0;
};

}  // namespace deliso
