#include "volume/filters/meshed_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/filters/gaussian.h"
#include "volume/filters/labels.h"
#include "volume/isovalue_range.h"

namespace deliso {

namespace {

void check_isovalue_of(const ScalarGrid& grid, double isovalue, const FieldParameters& parameters, bool is_closed) {
  if (!std::isfinite(isovalue)) throw InputError("isovalue " + shortest_text(isovalue) + " is not a finite number");
  if (is_closed ? has_solid(grid, isovalue, inside_of(parameters)) : has_isosurface(grid, isovalue)) return;
  if (parameters.label && parameters.smooth && grid.range().second <= kLabelIsovalue) {
    throw InputError("label " + std::to_string(*parameters.label) + " has no surface left: smoothed by " +
                     shortest_text(*parameters.smooth) + " voxels, 1 within it and 0 elsewhere becomes at most " +
                     shortest_text(grid.range().second) + ", expected above 0.5; smooth it less, or leave it out");
  }
  const std::string of_smoothed = parameters.smooth ? " (of the smoothed field)" : "";
  throw InputError("isovalue " + shortest_text(isovalue) +
                   " gives a surface with no point: " + isovalue_range_text(grid, isovalue) + of_smoothed);
}

// The layer that closes a solid is 2^30 times as far from the isovalue as the farthest sample (closing.h): throws
// InputError when it would overflow.
void check_closable(const ScalarGrid& grid, double isovalue) {
  constexpr double kLargest = 1e290;
  const auto [low, high] = grid.range();
  if (std::max({-low, high, std::abs(isovalue)}) <= kLargest) return;
  throw InputError("isovalue " + shortest_text(isovalue) + " and samples from " + shortest_text(low) + " to " +
                   shortest_text(high) +
                   ": expected them from -1e290 to 1e290 where the surface is closed, scale them");
}

}  // namespace

MeshedField meshed_field(const ScalarGrid& grid, double isovalue, const FieldParameters& parameters, bool is_closed,
                         const Vec3& spacing, int threads) {
  check_samples(grid);
  MeshedField field{grid, isovalue};
  if (parameters.label) field = {label_mask(grid, *parameters.label), kLabelIsovalue};
  if (parameters.smooth) {
    field.grid = smoothed(field.grid, sigma_in_spacings(*parameters.smooth, spacing), threads);
    check_samples(field.grid);
  }
  check_isovalue_of(field.grid, field.isovalue, parameters, is_closed);
  if (!is_closed) return field;
  check_closable(field.grid, field.isovalue);
  ClosedGrid closed = closed_grid(field.grid, field.isovalue, inside_of(parameters));
  return {std::move(closed.grid), closed.isovalue};
}

std::string field_text(const FieldParameters& parameters) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (parameters.label) add("label " + std::to_string(*parameters.label));
  if (parameters.smooth) {
    add("smoothed (sigma " + shortest_text(*parameters.smooth) + (*parameters.smooth == 1 ? " voxel)" : " voxels)"));
  }
  if (parameters.invert) add("inside below the isovalue");
  return text;
}

}  // namespace deliso
