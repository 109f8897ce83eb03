// The certificate of a mesh whose coordinates a file format rounds.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "delaunay/base/box3.h"
#include "surface/certificate/certificate.h"
#include "surface/mesh/io/mesh_file_options.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/affine.h"

namespace deliso {

// How a mesh leaves the grid's own coordinates: under a map to the world, whose rounding the verification undoes but
// for the last digits; STL and GLB, too, store coordinates as floats.
struct MeshOutput {
  Affine to_world;
  Vec3 spacing;  // of the grid
  MeshFormat format = MeshFormat::kPly;
  std::optional<double> metres;  // in a unit of the world, if it is known
  std::string name;              // what messages call it

  [[nodiscard]] double voxel() const { return std::min({spacing.x, spacing.y, spacing.z}); }
};

// A bound on how far the points of a mesh within the grid's box, or one spacing beyond, move by rounding; in voxels
// (the smallest spacing).
double rounding_of(const MeshOutput& output, const Box3& box);

// Rounding may make triangles cross, or (in STL) vertices coincide, or leave triangles without area, or move a vertex
// farther off the isosurface than the verification allows, or by more of the promised distance (voxels) than has been
// kept free for it (MeshingOptions::rounding). If it does so where it was not so before, the certificate gets a
// broken promise that says why. Nothing happens where nothing rounds, nor if a coordinate is beyond the range of
// floats: such a file is not written.
void judge_rounding(const TriangleMesh& mesh, const MeshOutput& output, double promised_distance,
                    Certificate& certificate);

}  // namespace deliso
