// What follows from the sizes that people state, for the stages.
#pragma once

#include <limits>
#include <optional>

#include "surface/base/parameters.h"

namespace deliso {

// The distance that a proven mesh keeps both ways, in smallest spacings.
inline double promised_distance(const Parameters& parameters) {
  return parameters.size.max_error.value_or(parameters.promise.max_distance);
}

// Whether distances of the isosurface from the mesh are kept within voxel cells too, and not on their edges alone.
inline bool is_measured_within_cells(const Parameters& parameters) {
  return parameters.size.max_error.has_value() || promised_distance(parameters) < 1;
}

// Whether the number of vertices follows from an error or a count, and not from the paper's criteria 1 and 2.
inline bool is_sized(const Parameters& parameters) {
  return parameters.size.max_error.has_value() || parameters.size.target_vertices.has_value();
}

// The height h that stage 2 refines above, in smallest spacings. It is measured at one point of each triangle: so less
// than what is promised.
double refined_height(const Parameters& parameters);

// The angle asked for, in degrees: by itself, or as the one that bounds the aspect ratio.
//
// The aspect ratio of a triangle is its longest edge over its smallest height (Shewchuk, What is a good linear
// element?, 2002): the sum of the cotangents of its two smaller angles. So it is at most twice the cotangent of the
// smallest one.
std::optional<double> wanted_angle(const SizeParameters& size);

// The largest radius-edge ratio that a stage may leave: its own rho, or the one that bounds the angle asked for. A
// triangle whose circumradius is rho times its shortest edge has the angle asin(1 / (2 rho)) across from that edge. The
// stages end with a rho of 1 or more; the shape stage does the rest.
double effective_rho(double rho, const SizeParameters& size);

// The h at or below which criteria 1 and 2 of stage 2 lapse (mesh-space units): stage2.h_min or the usual one. 0 where
// an error or a number of vertices is stated, which take the place of these criteria.
double effective_h_min(const Parameters& parameters);

// shape.min_angle, or the angle asked for.
std::optional<double> effective_min_angle(const Parameters& parameters);

inline double longest_edge_allowed(const Parameters& parameters) {
  return parameters.size.max_edge.value_or(std::numeric_limits<double>::infinity());
}

}  // namespace deliso
