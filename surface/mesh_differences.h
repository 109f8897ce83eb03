// Where the meshes of repair differ from the surface in topology, as far as sweeps along the axes tell.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/place_boxes.h"
#include "surface/surface_facts.h"
#include "surface/sweep_difference.h"
#include "surface/trouble.h"

namespace deliso {

class MeshDifferences {
 public:
  // Keeps references.
  MeshDifferences(const SurfaceFacts& facts, const Isosurface& isosurface) : facts_(facts), isosurface_(isosurface) {}

  // For each component that is not done and whose main piece has another topology: the places at which the two part, if
  // they are no more than `most` in all. Known when asked for again.
  const std::vector<Places>& find(const std::shared_ptr<MatchedMesh>& mesh, const std::vector<bool>& done,
                                  std::size_t most);

 private:
  void find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components);
  // `boxes`: of the parts with several places.
  void count_in_boxes(const MatchedMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                      const std::vector<std::uint32_t>& part_of_component,
                      std::vector<std::optional<PlaceBoxes>>& boxes) const;

  const SurfaceFacts& facts_;
  const Isosurface& isosurface_;
  std::vector<Places> places_;     // as last found
  std::weak_ptr<MatchedMesh> of_;  // in this mesh,
  std::size_t most_ = 0;           // of each component if they were no more
};

}  // namespace deliso
