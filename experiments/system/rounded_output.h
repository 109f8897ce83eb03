// The certificate of a mesh whose coordinates a file format rounds.
#pragma once

#include <filesystem>

#include "surface/certificate/certificate.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// STL stores coordinates as floats. This rounding may make vertices coincide, or triangles cross, or move a vertex
// farther off the isosurface than the verification allows (`voxel`: the smallest spacing). If it does so where it was
// not so before, the certificate gets a broken promise that says why. Nothing happens for other formats, nor if a
// coordinate is beyond the range of floats: such a file is not written.
void judge_rounding(const TriangleMesh& mesh, double voxel, const std::filesystem::path& path,
                    Certificate& certificate);

}  // namespace deliso
