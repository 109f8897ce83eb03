// Checks of one mesh again and again while few of its triangles change.
//
// What is off is mended in rounds, each of which changes few triangles and needs a check. On a smooth volume, whose
// triangles are many voxels large, a check takes longer than all else, since it asks for each crossing of the
// isosurface. So what the check before tells is kept: how many samples of a triangle are far is asked of new triangles
// only, and whether a crossing is missed only near triangles that are new or gone. The result is that of a check of the
// whole mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/geometry_check.h"
#include "surface/certificate/promise.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

class RepeatedCheck {
 public:
  // Keeps a reference. Which components are dropped must stay the same.
  RepeatedCheck(const ExactSurface& surface, const Promise& promise) : surface_(surface), promise_(promise) {}

  [[nodiscard]] const Promise& promise() const { return promise_; }
  // check_geometry() of a mesh, and check_distances(). The same for any number of threads.
  GeometryCheck operator()(const SurfaceMesh& mesh) { return checked(mesh, check_geometry); }
  GeometryCheck distances(const SurfaceMesh& mesh) { return checked(mesh, check_distances); }
  // The same of the mesh checked last, with a promise of no smaller distances: what is within those promised here is
  // not measured again.
  [[nodiscard]] GeometryCheck again_within(const Promise& promise, const SurfaceMesh& mesh) const;

 private:
  GeometryCheck checked(const SurfaceMesh& mesh, decltype(check_geometry)& kind);
  [[nodiscard]] std::optional<KnownBefore> known_of(const SurfaceMesh& mesh) const;

  const ExactSurface& surface_;
  Promise promise_;
  bool has_checked_ = false;
  SurfaceMesh last_;                        // points and triangles of the mesh checked last
  std::vector<std::int32_t> far_parts_;     // of each of these triangles
  std::vector<std::uint32_t> missed_;       // GeometryCheck::missed_numbers
  std::vector<MissedPlace> missed_places_;  // and ::missed_places
  std::vector<std::uint64_t> crossed_cells_;
};

}  // namespace deliso
