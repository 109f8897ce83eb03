// Where a mesh differs from the isosurface, as far as signs of it can be seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/located_critical_points.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// What trouble is looked for in. References must outlive the search.
struct DefectContext {
  const ExactSurface& surface;
  const SignedDelaunay& restricted;
  const MatchedMesh& mesh;
  const CellLevels& cells;
  const std::vector<std::uint32_t>& component_of_vertex;  // of the triangulation: the exact component it lies on
  const std::vector<bool>& done;                          // of each exact component: needs no more work
  const std::vector<IndexRanges>& places;                 // of each exact component
  bool is_near_places = true;              // of components with places, trouble counts near these alone: sweeps err
  std::span<const std::uint8_t> evidence;  // in the raised cells, by slot (sign_constraints.h); may be empty
  LocatedCriticalPoints& critical;         // of the volume, in the triangulation
};

// The voxel cells near the trouble of the components that are not done; may repeat cells. Signs of trouble: vertices
// that had to be split; triangles between two components; pieces beside the main piece of their component; tetrahedra
// that reach from one side of the isovalue to the other; vertices of the triangulation that no triangle uses; saddles
// and critical samples in tetrahedra of the other sign. Of a component whose piece has the right topology only what
// tells of its missing part, or of the vertices it shares with others, counts. For a component without any sign its
// saddles are taken, and when there are none all its crossings. Of a component with known places only cells near them
// are taken, if wanted, and all active ones very near the likely ones.
std::vector<CellName> defect_cells(const DefectContext& context);

}  // namespace deliso
