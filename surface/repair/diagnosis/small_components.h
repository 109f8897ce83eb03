// Components so small that what is near enough elsewhere would miss half of them.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

// The components with few grid-edge crossings, and where these are. The mesh of one must come near each of them: a
// piece may have the right topology and be as flat as a leaf, when the crossings on one side of it are left out.
class SmallComponents {
 public:
  explicit SmallComponents(const ExactSurface& surface);

  // The specks whose main piece lies away from some crossing by more than a part of the speck's size, ascending.
  [[nodiscard]] std::vector<std::uint32_t> missed_by(const MatchedMesh& mesh) const;

 private:
  static constexpr std::uint32_t kNoSmallComponent = 0xFFFFFFFFu;
  struct Speck {
    std::uint32_t component = 0;
    double farthest = 0;  // that a crossing may be away from the mesh
    std::vector<Vec3> crossings;
  };
  std::vector<Speck> specks_;
  std::vector<std::uint32_t> speck_of_;  // of each component
};

}  // namespace deliso
