// Triangles too far from the isosurface, at which stage 2 can insert nothing: in wedges and where sheets nearly meet.
#pragma once

#include <cstdint>
#include <span>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/shape/shape_options.h"

namespace deliso {

struct Nearness {
  double most = 0;              // that a sample of a triangle may be away from the isosurface (mesh-space units)
  bool removes_spikes = false;  // first: vertices of one sheet to which another has come to reach
};

// Improves triangles of a mesh in mesh space of which samples are too far from the isosurface, by the steps of the
// shape stage and within its guard: each step leaves less area that is too far. Only points and triangles are kept. The
// same for any number of threads.
void bring_near(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const std::uint32_t> far,
                const Nearness& wanted, const ShapeOptions& options, const Controls& controls, ShapeStats& stats);

// The same for points of the isosurface that are too far from the mesh, as at tips of thin parts: each becomes a
// vertex, in the nearest triangle of a piece on its own component or in that and neighbours of it, where the guard
// allows it with this freedom. (A triangle of another component may be nearer: with the tip of a finger it would be a
// sphere around nothing.)
void insert_missed(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const Vec3> points, double freedom,
                   const ShapeOptions& options, const Controls& controls, ShapeStats& stats);

}  // namespace deliso
