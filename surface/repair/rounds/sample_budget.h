// When repair gives components up: their samples of all rounds together are many more than their crossings.
//
// Marching cubes has the exact topology with a vertex for each crossing. Where a surface is smooth, stage 1 needs a
// fraction of that, and rounds, of which each costs what its samples cost, are worth it. In masks and noise it takes as
// many samples as there are crossings, or twice as many, most cells are wrong in some way, and rounds make as much
// wrong as they mend: eight of them may end in marching cubes all the same. RefineGeom makes no more vertices of the
// crossings then, and better triangles. So a component of twice as many samples as crossings is given up at once, one
// of as many after a round, and one of a quarter has all eight. Some samples more are granted, to all components
// together: there may be thousands of few crossings, which lattices give a hundred times as many samples (ANEURISM at
// 0.5). (In flat cells marching cubes takes a finer grid: cell_pieces.h.) Where an error is stated nothing is given up:
// samples are needed there, and a random mask of 10^3 at 0.05 voxels takes 20 times as long from marching cubes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"

namespace deliso {

class SampleBudget {
 public:
  explicit SampleBudget(const ExactSurface& surface);

  // Spends the samples before a round, given the exact component of each, or kNoComponent. Returns the components to
  // give up, of those not done, ascending: all that have spent more than they had, once that exceeds what is granted
  // beyond. One that has a right mesh among stray pieces may still be taken from there (component_selection.h).
  std::vector<std::uint32_t> spend(std::span<const std::uint32_t> component_of_sample, const std::vector<bool>& done);

 private:
  std::vector<double> left_;  // of each exact component: samples
};

}  // namespace deliso
