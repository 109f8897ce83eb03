// The pieces of a mesh matched with the exact components of the isosurface, by position and by topology.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/mesh/surface_mesh.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

inline constexpr std::uint32_t kNoPiece = 0xFFFFFFFFu;

// A connected piece of a mesh.
struct MeshPiece {
  ComponentTopology topology;
  std::int64_t vertices = 0;
  std::uint32_t component = 0;  // the exact component that most of its vertices lie on, or kNoComponent
  bool mixed = false;           // it has vertices of other components, too
};

// How a component agrees with its main piece, the largest piece that lies on it. kPartial and kDisplaced are set by
// callers that know the surface; match_components never sets them.
enum class Agreement {
  kNone,        // no piece, or one of another topology
  kPartial,     // the same (Euler characteristic, boundary loops), but the piece is far from a part of the component
  kDisplaced,   // the same, but a handle is missing at one place, and at another there is one too many; or
                // triangles span what is no isosurface
  kMixed,       // the same, but the piece also has vertices of other components
  kWithStrays,  // the same, and there are smaller pieces on the component
  kExact,       // the same, and there is no other piece
};

struct ComponentMatch {
  std::vector<MeshPiece> pieces;
  std::vector<std::uint32_t> piece_of;    // of each mesh vertex; kNoPiece for one without triangles
  std::vector<std::uint32_t> main_piece;  // of each exact component; kNoPiece when it has none
  std::vector<Agreement> agreement;       // of each exact component
  // The number of components that do not agree exactly, plus the number of stray pieces, plus the differences in Euler
  // characteristic of the main pieces. Smaller is better; 0 when the mesh is right.
  std::int64_t error = 0;

  // Whether a piece is the main piece of the component that it lies on.
  [[nodiscard]] bool is_main(std::uint32_t piece) const {
    const std::uint32_t component = pieces[piece].component;
    return component < main_piece.size() && main_piece[component] == piece;
  }
};

// The pieces and their topology only; their components are not set.
ComponentMatch find_pieces(const SurfaceMesh& mesh);

// `component_of`: the exact component of each mesh vertex; kNoComponent for one that lies on none and does not count.
ComponentMatch match_components(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                const std::vector<ComponentTopology>& components);

}  // namespace deliso
