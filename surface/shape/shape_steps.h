// The steps that may improve a badly shaped triangle: flips, removals, moves, merges, splits and insertions.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/shape/patch.h"
#include "surface/shape/place_search.h"

namespace deliso {

class ShapeSteps {
 public:
  ShapeSteps(const Patch& patch, const Isosurface& isosurface, SearchCounters& counters)
      : patch_(patch), search_(isosurface, counters) {}

  void set_thorough(bool is_so) { search_.set_thorough(is_so); }

  // Appends the steps of a kind at a corner of a triangle, or at the side across from it, that replace the triangle,
  // each with its quality. Searches end at `enough`.
  void propose(ShapeStep kind, std::uint32_t triangle, std::size_t corner, double enough,
               std::vector<PatchStep>& steps);

  // Appends the split of a side in its middle, whatever its quality.
  void bisect(std::uint32_t triangle, std::size_t corner, std::vector<PatchStep>& steps);

  // Appends the move of an inner vertex by this share of its way to a neighbour, onto the isosurface, whatever its
  // quality.
  void displace(std::uint32_t v, std::uint32_t neighbour, double share, std::vector<PatchStep>& steps);

  // Brings the point of a step half the way back to where its search started, on the isosurface; false when it cannot.
  bool halve(PatchStep& step);

 private:
  // A side of a triangle: from a to b, across from c; d is the apex beyond it.
  struct Side {
    std::uint32_t triangle, a, b, c;
    std::uint32_t beyond = kNoVertex;  // the triangle across, if there is one
    std::uint32_t d = kNoVertex;
  };
  [[nodiscard]] Side side_of(std::uint32_t triangle, std::size_t corner) const;
  [[nodiscard]] std::optional<Vec3> middle_of(const Side& side);
  void flip(const Side& side, double enough, std::vector<PatchStep>& steps);
  void drop(const Side& side, std::vector<PatchStep>& steps);
  void drop_two(const Side& side, std::vector<PatchStep>& steps);
  void open(const Side& side, double enough, std::vector<PatchStep>& steps);
  void remove_ear(std::uint32_t v, std::vector<PatchStep>& steps);
  void remove(std::uint32_t v, std::vector<PatchStep>& steps);
  [[nodiscard]] std::optional<PatchStep> star_of(std::uint32_t v);
  void move(std::uint32_t v, double enough, std::vector<PatchStep>& steps);
  void merge(const Side& side, double enough, std::vector<PatchStep>& steps);
  void split(const Side& side, double enough, std::vector<PatchStep>& steps);
  void insert(std::uint32_t triangle, double enough, std::vector<PatchStep>& steps);

  void merge(std::uint32_t kept, std::uint32_t gone, bool is_boundary_edge, double enough,
             std::vector<PatchStep>& steps);

  // Completes a step that makes the star of its vertex over a rim: finds the best place, on the isosurface or on the
  // boundary curve.
  void place(PatchStep step, const std::vector<Vec3>& starts, double enough, std::vector<PatchStep>& steps);
  void place_on_curve(PatchStep step, const std::vector<Vec3>& starts, const BoundaryCurve& curve, double enough,
                      std::vector<PatchStep>& steps);
  static void finish(PatchStep step, const Place& best, const std::vector<Vec3>& starts, std::vector<PatchStep>& steps);
  [[nodiscard]] std::optional<BoundaryCurve> curve(std::uint32_t begin, std::uint32_t end,
                                                   std::initializer_list<std::uint32_t> between) const;
  [[nodiscard]] bool are_whole(const std::vector<std::uint32_t>& triangles) const;
  [[nodiscard]] Vec3 normal_of(const std::vector<std::uint32_t>& triangles) const;

  const Patch& patch_;
  PlaceSearch search_;
  VertexLink link_, other_link_;
  std::vector<RimSegment> rim_;
};

}  // namespace deliso
