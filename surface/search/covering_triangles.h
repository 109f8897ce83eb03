// Which triangles of a mesh cover given samples, that is, lie within a stated distance of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Whether a sample lies within nearness::kSample (nearness.h) of a triangle.
bool is_covered_by(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle);
// For each of a few points, on several threads: the first triangle t that covers it and for which takes(t) holds;
// kNoTriangle when there is none.
inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;
std::vector<std::uint32_t> covering_triangles(const std::vector<Vec3>& points, const SurfaceMesh& mesh,
                                              const std::function<bool(std::uint32_t)>& takes, int threads = 1);

}  // namespace deliso
