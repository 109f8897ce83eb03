// Which pieces of a mesh are left out on purpose: cavities, small ones, all but the largest.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/base/parameters.h"
#include "surface/mesh/surface_mesh.h"
#include "volume/filters/closing.h"

namespace deliso {

// A connected piece of a mesh. In the mesh's units.
struct MeasuredPiece {
  std::int64_t vertices = 0;
  double area = 0;
  std::optional<double> volume;  // of a closed one: below 0 when the inside lies around it, as around a cavity
  Vec3 at;                       // its first vertex
};

enum class DropCause { kNone, kCavity, kSmall, kNotLargest };

// What was left out.
struct DroppedPiece {
  MeasuredPiece piece;
  DropCause cause = DropCause::kNone;
};

struct MeasuredPieces {
  std::vector<MeasuredPiece> pieces;
  std::vector<std::uint32_t> piece_of;  // of each triangle
};
// Precondition: the mesh has neighbours (set_side_adjacency), and its triangles face lower values, on whichever side
// the inside is.
MeasuredPieces measure_pieces(const SurfaceMesh& mesh, Inside inside = Inside::kAbove);

// Why each piece is left out, if it is. Ties of areas keep the earlier piece.
std::vector<DropCause> pieces_to_drop(const SurfaceMesh& mesh, const MeasuredPieces& measured,
                                      const ComponentParameters& wanted);

}  // namespace deliso
