// Where a mesh differs from the isosurface, as far as signs of it can be seen.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/critical_places.h"
#include "surface/raised_cells.h"
#include "surface/signed_delaunay.h"
#include "volume/exact_topology.h"

namespace deliso {

// A mesh of the whole surface and what it was matched with.
struct MatchedMesh {
  BuiltMesh built;
  std::vector<std::uint32_t> component;  // of each mesh vertex: the exact component it lies on
  ComponentMatch match;
};

// Where sweeps see a component and its main piece part: along each axis the layers near which they do. Empty when there
// is no telling.
struct Places {
  std::array<std::vector<std::int32_t>, 3> layers;

  [[nodiscard]] std::size_t count() const { return layers[0].size() * layers[1].size() * layers[2].size(); }
  [[nodiscard]] bool empty() const { return count() == 0; }
  // How many layers a cell is away, along the axis along which it is farthest.
  [[nodiscard]] std::int32_t distance(const CellIndex& cell) const;
  [[nodiscard]] bool near(const CellIndex& cell, std::int32_t reach) const { return distance(cell) <= reach; }
};

// Places::distance of many cells of a volume with so many samples.
class DistanceFromPlaces {
 public:
  DistanceFromPlaces(const Places& places, const std::array<std::int32_t, 3>& dims);
  [[nodiscard]] std::int32_t operator()(const CellIndex& cell) const {
    return std::max({layers_[0][static_cast<std::size_t>(cell[0])], layers_[1][static_cast<std::size_t>(cell[1])],
                     layers_[2][static_cast<std::size_t>(cell[2])]});
  }

 private:
  std::array<std::vector<std::int32_t>, 3> layers_;  // along each axis: of each layer, how many layers it is away
};

// What trouble is looked for in. References must outlive the search.
struct TroubleContext {
  const ScalarGrid& grid;
  const IsosurfaceTopology& topology;
  const SignedDelaunay& restricted;
  const MatchedMesh& mesh;
  const RaisedCells& cells;
  const std::vector<std::uint32_t>& component_of_vertex;  // of the triangulation: the exact component it lies on
  const std::vector<bool>& done;                          // of each exact component: needs no more work
  std::vector<Places> places;                             // of each exact component
  std::span<const std::uint8_t> evidence;                 // in the raised cells, by slot (evidence.h); may be empty
  LocatedPlaces& critical;                                // of the volume, in the triangulation
  int threads = 1;                                        // nothing but the time depends on it
};

// The voxel cells near the trouble of the components that are not done; may repeat cells. Signs of trouble: vertices
// that had to be split; triangles between two components; pieces beside the main piece of their component; tetrahedra
// that reach from one side of the isovalue to the other; vertices of the triangulation that no triangle uses; saddles
// and critical samples in tetrahedra of the other sign. Of a component whose piece has the right topology only what
// tells of its missing part, or of the vertices it shares with others, counts. For a component without any sign its
// saddles are taken, and when there are none all its crossings. Of a component with known places only cells near them
// are taken, and all active ones very near.
std::vector<CellName> cells_in_trouble(const TroubleContext& context);

}  // namespace deliso
