// The certificate of a mesh whose coordinates a file format rounds.
#pragma once

#include <optional>
#include <string>

#include "surface/certificate/certificate.h"
#include "surface/mesh/io/mesh_file_options.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/affine.h"

namespace deliso {

// A mesh is written under a map from the grid's own coordinates to the world, whose rounding the verification undoes
// but for the last digits; STL and GLB, too, store coordinates as floats. This rounding may make triangles cross, or
// (in STL) vertices coincide, or leave triangles without area, or move a vertex farther off the isosurface than the verification allows (`voxel`: the
// smallest spacing; `metres`: in a unit of the world, if it is known). If it does so where it was not so before, the
// certificate gets a broken promise that says why. Nothing happens where neither rounds, nor if a coordinate is beyond
// the range of floats: such a file is not written.
void judge_rounding(const TriangleMesh& mesh, const Affine& to_world, double voxel, const std::string& path,
                    MeshFormat format, std::optional<double> metres, Certificate& certificate);

}  // namespace deliso
