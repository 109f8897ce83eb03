// What is left of a certificate in a file that cannot hold the mesh's coordinates.
#pragma once

#include <filesystem>

#include "surface/certificate/certificate.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// STL keeps coordinates as floats. When rounding them makes vertices coincide, or triangles cross, which did not
// before, or takes a vertex farther off the isosurface than verification allows (`voxel`: the smallest spacing), the
// certificate's verdict becomes kDifferent, with a sentence that says so. Nothing happens for other formats, nor where
// a coordinate is beyond the range of floats: such a file is not written.
void judge_rounding(const TriangleMesh& mesh, double voxel, const std::filesystem::path& path,
                    Certificate& certificate);

}  // namespace deliso
