// The voxel cells near visible defects of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The data in which defects are searched. References must outlive the search.
struct DefectContext {
  const ExactSurface& surface;
  const SignedDelaunay& restricted;
  const MatchedMesh& mesh;
  const CellLevels& cells;
  const std::vector<std::uint32_t>& component_of_vertex;  // of each vertex of the triangulation: its exact component
  const std::vector<bool>& done;                          // of each exact component
  // Of each exact component: where it differs from its main piece.
  const std::vector<IndexRanges>& boxes;
  // For components with boxes, only defects near the boxes count. For displaced ones that is always so.
  bool is_near_boxes = true;
};

// The voxel cells near the defects of the components that are not done; a cell may be listed several times. Defects
// are: pinches, whose vertices had to be split; triangles between two components; stray pieces beside the main piece of
// their component; vertices of the triangulation that no triangle uses; and saddles and critical samples in tetrahedra
// of the other sign. If the piece of a component has the right topology, only those defects count that concern its
// missing part, or the vertices that it shares with other components. For a component without any defect its saddles
// are taken, and if there are none, all its crossings. For a component with boxes only defects near the boxes count (if
// is_near_boxes), and on the volume's box where its piece has another number of boundary loops; and if the likely boxes
// are few, all active cells very near them are added.
std::vector<CellName> defect_cells(const DefectContext& context);

}  // namespace deliso
