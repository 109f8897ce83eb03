// Where a mesh differs from the isosurface, as far as signs of it can be seen.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/located_critical_points.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// What defects are looked for in. References must outlive the search.
struct DefectContext {
  const ExactSurface& surface;
  const SignedDelaunay& restricted;
  const MatchedMesh& mesh;
  const CellLevels& cells;
  const std::vector<std::uint32_t>& component_of_vertex;  // of the triangulation: the exact component it lies on
  const std::vector<bool>& done;                          // of each exact component: needs no more work
  const std::vector<IndexRanges>& boxes;                  // of each exact component: where it and its main piece part
  bool is_near_boxes = true;                              // of components with boxes, defects count near these alone
  LocatedCriticalPoints& critical;                        // of the volume, in the triangulation
};

// The voxel cells near the defects of the components that are not done; may repeat cells. Defects are vertices that had
// to be split; triangles between two components; pieces beside the main piece of their component; vertices of the
// triangulation that no triangle uses; and saddles and critical samples in tetrahedra of the other sign. Of a component
// whose piece has the right topology only what tells of its missing part, or of the vertices it shares with others,
// counts. For a component without any defect its saddles are taken, and when there are none all its crossings. Of a
// component with boxes only defects near them count, if wanted, and all active cells very near the likely ones are
// taken where the boxes are few.
std::vector<CellName> defect_cells(const DefectContext& context);

}  // namespace deliso
