// The best collapse of a vertex: it goes, and the rest of its link is joined to one vertex of the link. This is a
// half-edge collapse (Kobbelt, Campagna and Seidel, A general framework for mesh decimation, 1998); all vertices that
// stay keep their places on the isosurface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/shape/component_size.h"
#include "surface/shape/patch.h"
#include "surface/sizes/decimation_options.h"
#include "surface/sizes/witnesses.h"

namespace deliso {

class CollapseSearch {
 public:
  // Keeps references to all; the mesh may change between searches. Several may search the same mesh at the same time.
  CollapseSearch(const Patch& mesh, const Witnesses& witnesses, const Isosurface& isosurface,
                 const DecimationOptions& options, SearchCounters& counters);

  // The error of the best collapse: how far mesh and isosurface would be from each other around it, not above
  // options.max_error. Nothing when the vertex must stay. With `is_last` no triangle of it meets another of the mesh
  // beyond what they share, and no small component shrinks to nothing.
  std::optional<double> find(std::uint32_t vertex, bool is_last);
  // The one found last.
  [[nodiscard]] const PatchStep& step() const { return best_; }
  [[nodiscard]] double mean_edge() const { return mean_edge_; }
  // Whether the mesh as it is now keeps half of what a small closed component encloses, and its sign, when a vertex
  // goes.
  [[nodiscard]] bool keeps_volume(const PatchStep& step, std::uint32_t vertex);

 private:
  struct Candidate {
    std::size_t apex;  // in the link
    double score;
  };
  bool learn_star(std::uint32_t vertex);
  void consider(std::size_t apex);
  [[nodiscard]] bool keeps_links(std::uint32_t kept, std::size_t apex) const;
  [[nodiscard]] bool keeps_boundary(std::size_t apex) const;
  void make_step(std::size_t apex);
  [[nodiscard]] double distance_of_isosurface(double limit) const;
  [[nodiscard]] double distance_of_mesh(double limit);
  [[nodiscard]] double distance_at(const Vec3& p, const Vec3& normal, double limit);
  [[nodiscard]] bool stays_near() const;
  [[nodiscard]] bool meets_nothing();
  [[nodiscard]] std::array<Vec3, 3> points_of(const std::array<std::uint32_t, 3>& corners) const {
    return {mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2])};
  }

  const Patch& mesh_;
  const Witnesses& witnesses_;
  const Isosurface& isosurface_;
  const DecimationOptions& options_;
  SearchCounters& counters_;
  double goal_;  // the sine of min_angle

  std::uint32_t vertex_ = 0;
  VertexLink link_;
  std::vector<Vec3> normals_;  // of the star's triangles, of unit length
  std::vector<double> areas_;
  double least_sine_ = 0;  // of the star
  double mean_edge_ = 0;   // from the vertex to its link
  double longest_edge_ = 0;
  std::vector<Candidate> candidates_;
  PatchStep best_, tried_;
  std::vector<std::uint32_t> near_;
  ComponentSize component_;
  std::vector<Vec3> samples_;
};

}  // namespace deliso
