// The parameters of the mesher. Defaults are the paper's where it gives them. The table in
// surface/base/parameter_table.h names them for files, the command line and the library.
#pragma once

#include <cstdint>
#include <optional>

#include "delaunay/base/vec3.h"
#include "raycast/search_options.h"
#include "volume/filters/meshed_field.h"
#include "volume/region.h"

namespace deliso {

enum class Algorithm { kTwoStage, kFull3d };
enum class Seeding { kComponents, kRandom };
enum class Boundary { kOpen, kClosed };
enum class SpacingUse { kUse, kIgnore };
enum class PoleHeight { kNearer, kFarther, kMean };
enum class Criterion2 { kCircumradius, kShortestEdge };
enum class NewPole { kMean, kNearest };
enum class RMinOf { kVoxels, kBox };
enum class QueueOrder { kWorstFirst, kFirstInFirstOut, kLargestRadius };

struct InitialParameters {
  std::int32_t random_points = 0;          // hits of random rays; >= 0
  Seeding seeding = Seeding::kComponents;  // seeds on every component, or the random points alone
};

struct Stage1Parameters {
  double epsilon = 0.2;            // h / r above which a triangle is refined; > 0
  double rho = 2.0;                // r / l above which a triangle is refined; >= 1
  double r_min = 0.001;            // no geometric refinement at or below this radius, as a fraction of b; >= 0
  bool coverage = true;            // also sample parts of the surface that the mesh misses; needs the exact topology
  double size_bound_voxels = 0.3;  // no insertion nearer than this to a vertex, in smallest spacings; >= 0
  bool one_sign_per_tetrahedron = true;  // facets are restricted by two signs; else each by the hits of its dual edge
};

struct Stage2Parameters {
  double epsilon1 = 0.1;                              // h / r above which a triangle is refined; > 0
  double epsilon2 = 0.2;                              // r / mean pole height above which a triangle is refined; > 0
  double rho = 2.0;                                   // r / l above which a triangle is refined; >= 1
  double r_min = 0.001;                               // no refinement at or below this radius, as a fraction of b; >= 0
  std::optional<double> max_distance;                 // h above which a triangle is refined, in smallest spacings; > 0
  std::optional<double> h_min;                        // h at or below which criteria 1 and 2 lapse, likewise; >= 0;
                                                      // else by the thresholds (effective_h_min())
  Criterion2 criterion2 = Criterion2::kCircumradius;  // what is compared with the mean pole height
  NewPole new_pole = NewPole::kMean;  // a new vertex takes its neighbours' mean pole height, or the nearest one's
  bool store_hits = true;             // keep x_sigma with each triangle; else it is searched whenever it is needed
  PoleHeight pole_height = PoleHeight::kNearer;  // which of a vertex's two poles gives its height
};

struct RepairParameters {
  std::int32_t max_rounds = 8;  // 0 turns repair off
};

struct ShapeParameters {
  std::optional<double>
      min_angle;               // improve triangles with a smaller angle, in degrees; > 0, <= 35; else by stage2.rho
  std::int32_t smoothing = 1;  // passes over the vertices at the end of stage 2; >= 0
  std::int32_t rounds = 4;     // 0 turns the stage off, and smoothing
};

struct PromiseParameters {
  // What a proven mesh is within, both ways, in smallest spacings; > 0. With repair, refinement goes on until it is.
  double max_distance = 1;
};

// Sizes as people state them (surface/base/sizes.h has what follows from them for the stages).
struct SizeParameters {
  // Mesh and isosurface are within this of each other, in smallest spacings; > 0. It is promised, and takes the place
  // of criteria 1 and 2, and the mesh gets as few vertices as that allows.
  std::optional<double> max_error;
  std::optional<double> max_edge;    // no longer edge, in smallest spacings; >= kLeastMaxEdge
  std::optional<double> min_angle;   // no smaller angle, in degrees; > 0, <= 35: sets rho and shape.min_angle
  std::optional<double> max_aspect;  // no larger longest edge over smallest height; >= 3
  std::optional<std::int64_t> target_vertices;  // so many vertices, within 2 %; >= 4
};

// Which components of the isosurface are kept; lengths in smallest spacings. Cavities go first, then small ones, then
// all but the largest.
struct ComponentParameters {
  bool fill_cavities = false;                // leave out closed components that bound a hole in what is inside
  std::optional<std::int64_t> min_vertices;  // leave out those whose mesh has fewer vertices; >= 1
  std::optional<double> min_area;            // or less area; > 0
  std::optional<double> min_volume;  // or encloses less; > 0. One that ends at the box encloses nothing, and stays.
  std::optional<std::int64_t> keep_largest;  // keep so many, by area; >= 1
};

// The samples that are meshed, along each axis from the first to the last, both included.
struct RegionParameters {
  std::optional<std::int32_t> i0, i1, j0, j1, k0, k1;  // null: the first, or the last, of the volume
};

struct BudgetParameters {
  std::optional<double> seconds;             // stop refining after this wall-clock time; > 0
  std::optional<std::int64_t> max_vertices;  // stop refining at this many vertices; >= 4
};

struct Parameters {
  Algorithm algorithm = Algorithm::kTwoStage;
  InitialParameters initial;
  Stage1Parameters stage1;
  Stage2Parameters stage2;
  RMinOf r_min_of = RMinOf::kVoxels;  // r_min is a fraction of 256 smallest spacings, or of the smallest side of the
                                      // volume's box, as in the paper
  QueueOrder queue_order = QueueOrder::kWorstFirst;
  FieldParameters field;
  Boundary boundary = Boundary::kOpen;
  SearchOptions search;
  SpacingUse spacing = SpacingUse::kUse;
  bool certify = true;
  RepairParameters repair;
  ShapeParameters shape;
  PromiseParameters promise;
  SizeParameters size;
  ComponentParameters components;
  RegionParameters region;
  BudgetParameters budget;
};

// Whether a mesh that differs from the exact topology is repaired.
inline bool repairs(const Parameters& parameters) { return parameters.certify && parameters.repair.max_rounds > 0; }

// Whether badly shaped triangles are improved after stage 2: not without repair, which sees to it that none cross.
inline bool improves_shape(const Parameters& parameters) {
  return repairs(parameters) && parameters.algorithm == Algorithm::kTwoStage && parameters.shape.rounds > 0;
}

// Throws InputError when some parameters contradict each other.
void check_parameters(const Parameters& parameters);

// The least distance that can be promised, in voxels: for less a mesh of a few cells has millions of vertices.
inline constexpr double kLeastDistance = 1e-6;

// The shortest edge that all can be asked to keep to, in voxels: for less a mesh of a few cells has millions of
// vertices.
inline constexpr double kLeastMaxEdge = 1e-3;

// The region as the grid takes it.
SampleRegion region_of(const RegionParameters& region);

// Whether any component may be left out.
bool drops_components(const ComponentParameters& components);

// The sample spacing to mesh with: that of the volume, or 1. Throws InputError when its components differ by a factor
// above 1000: a mesh adapted to the smallest one grows with the square of that factor.
Vec3 spacing_to_use(const Parameters& parameters, const Vec3& of_volume);

}  // namespace deliso
