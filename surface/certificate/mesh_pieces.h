// The connected pieces of a mesh, and the exact components that their vertices lie on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// Marks all triangles that hang together with one across their sides; returns them. Precondition: none is marked.
std::vector<std::uint32_t> flood(const SurfaceMesh& mesh, std::uint32_t seed, std::vector<bool>& is_marked);

// Each vertex of some triangles once, ascending.
std::vector<std::uint32_t> vertices_of(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles);

// The component of a vertex that was moved off the isosurface.
inline constexpr std::uint32_t kNoComponent = 0xFFFFFFFFu;
// The exact component on which each of some vertices lies.
std::vector<std::uint32_t> components_at(const SurfaceMesh& mesh, std::span<const std::uint32_t> vertices,
                                         const ExactSurface& surface);
// That of most vertices, the first of equals; nothing when none has one.
std::optional<std::uint32_t> most_frequent(std::span<const std::uint32_t> components);

}  // namespace deliso
