// When a restricted triangle sigma is too coarse: the criteria of ApproximateGeom and RefineGeom (Dey and Levine,
// sections 3.1 and 3.2), and one of ours.
//
//   RefineGeom (3.2)           ApproximateGeom (3.1)
//   1. h / r > epsilon1        1. h / r > epsilon       how far sigma is from the surface
//   2. r / h_mean > epsilon2                            its size against that of the surface's features
//   3. r / l > rho             2. r / l > rho           its aspect ratio
//   4. r > r_min               3. r > r_min             not too small to be refined
//      h > max_distance           h > max_distance      ours: the absolute distance to the surface
//
// x_sigma is inserted when sigma is larger than r_min and one of the others holds. Ours, too: where h is at or below
// h_min and r no larger than a voxel, criteria 1 and 2 of stage 2 lapse. At a crease of the isosurface, where voxel
// cells meet, h / r stays what it is however small the triangles are, and poles come down to the surface: both would be
// refined to r_min everywhere. Of a larger triangle h, which is measured in one place, tells too little.
#pragma once

#include <algorithm>
#include <limits>

#include "delaunay/base/box3.h"
#include "surface/base/parameters.h"

namespace deliso {

// The thresholds. Lengths in mesh-space units.
struct Criteria {
  double epsilon = 0.2;  // largest h / r; epsilon1 of stage 2
  double rho = 2;        // largest r / l
  double r_min = 0;      // no refinement of triangles at or below this circumradius
  double max_distance = std::numeric_limits<double>::infinity();  // largest h
  double epsilon2 = std::numeric_limits<double>::infinity();      // largest r / h_mean; needs pole heights
  Criterion2 criterion2 = Criterion2::kCircumradius;              // or l / h_mean
  double h_min = 0;  // criteria 1 and 2 of stage 2 lapse at or below this h, where r is no larger than a voxel
};

// r_min in mesh space, from the fraction of the smallest side of a box that a parameter gives: one of 256 smallest
// spacings, or the volume's (r_min_of). At a crease of the isosurface h / r stays what it is however
// small the triangles are. A triangle as small as the distance that a vertex may be off the isosurface tells nothing by
// its shape: there refinement ends, whatever the fraction.
inline double absolute_r_min(double fraction, const Box3& box) {
  constexpr double kLeast = 1e-3;  // smallest spacings
  return std::max(fraction * box.smallest_side(), kLeast);
}

// What the criteria measure of sigma.
struct TriangleMeasures {
  double h = 0;       // from its circumcenter to x_sigma
  double r = 0;       // circumradius
  double l = 0;       // shortest edge
  double h_mean = 0;  // mean pole height of its vertices
};

// How far sigma is beyond each threshold: above 1 where the criterion holds. The numbers are those of section 3.2.
inline double badness1(const TriangleMeasures& sigma, const Criteria& limit) {
  return sigma.h / (sigma.r * limit.epsilon);  // 1. h / r > epsilon1
}
inline double badness2(const TriangleMeasures& sigma, const Criteria& limit) {
  const double size = limit.criterion2 == Criterion2::kCircumradius ? sigma.r : sigma.l;
  return size / (sigma.h_mean * limit.epsilon2);  // 2. r / h_mean > epsilon2
}
inline double badness3(const TriangleMeasures& sigma, const Criteria& limit) {
  return sigma.r / (sigma.l * limit.rho);  // 3. r / l > rho
}
inline bool exceeds_r_min(double r, const Criteria& limit) {
  return r > limit.r_min;  // 4. r > r_min
}
inline double distance_badness(const TriangleMeasures& sigma, const Criteria& limit) {
  return sigma.h / limit.max_distance;  // ours: h > max_distance
}

// Without a branch; what is not a number as `b` does not count.
inline double larger(double a, double b) { return a < b ? b : a; }

// The largest ratio to a threshold: above 1 when sigma is too coarse, unless it is too small to be refined.
inline double approximate_geometry_badness(const TriangleMeasures& sigma, const Criteria& limit) {
  return larger(larger(badness1(sigma, limit), badness3(sigma, limit)), distance_badness(sigma, limit));
}
// A badness of criterion 1 or 2 in stage 2: no more than 1 where they lapse.
inline double unless_lapsed(double badness, const TriangleMeasures& sigma, const Criteria& limit) {
  constexpr double kLargest = 1;  // mesh-space units: a voxel
  const double above = larger(sigma.h / limit.h_min, sigma.r / kLargest);
  return above < badness ? above : badness;
}
inline double refine_geometry_badness(const TriangleMeasures& sigma, const Criteria& limit) {
  const double by_ratio = larger(badness1(sigma, limit), badness2(sigma, limit));
  return larger(larger(unless_lapsed(by_ratio, sigma, limit), badness3(sigma, limit)), distance_badness(sigma, limit));
}

}  // namespace deliso
