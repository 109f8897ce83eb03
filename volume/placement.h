// Where a grid lies in the world: the affine map of its file, kept whole.
//
// A grid has coordinates of its own, in which sample (i, j, k) sits at origin + (i sx, j sy, k sz); the isosurface is
// meshed there. An axis-parallel volume has the world's coordinates for its own. Any other has its origin at 0 and the
// lengths of the map's columns for spacing; the placement turns it, reflects it, shears it and moves it, afterwards.
#pragma once

#include <string>
#include <string_view>

#include "delaunay/base/vec3.h"
#include "volume/affine.h"

namespace deliso {

struct Placement {
  Affine to_world;    // from the grid's own coordinates
  std::string space;  // what the world's axes are: "left-posterior-superior", ...; empty when the file does not say
  std::string units;  // of lengths in the world: "mm", ...; empty when the file does not say

  // Whether the world's coordinates are the grid's own.
  [[nodiscard]] bool is_identity() const { return to_world == Affine(); }
  [[nodiscard]] bool reflects() const { return to_world.determinant() < 0; }
  // The largest cosine between two of the grid's axes in the world.
  [[nodiscard]] double shear() const;
  [[nodiscard]] bool is_sheared() const {
    constexpr double kRounding = 1e-6;  // headers round their numbers
    return shear() > kRounding;
  }
};

// The spacing, origin and placement of a grid whose sample (i, j, k) sits at index_to_world(i, j, k). Directions along
// the axes x, y, z in this order, none reversed, are kept in spacing and origin alone.
struct SampleFrame {
  Vec3 spacing{1, 1, 1};
  Vec3 origin{};
  Affine to_world;
};
// Throws InputError when a direction is zero, not finite or in the plane of the others, or the place is so far away
// that coordinates cannot resolve 1e-4 of a spacing.
SampleFrame frame_of(const Affine& index_to_world);

// The placement in another space, "LPS" or "RAS"; "native" gives the placement as it is. Throws InputError when the
// volume's space is unknown or none of anatomy.
Placement in_space(const Placement& placement, std::string_view space);

// "left-posterior-superior" for "LPS" (in any case), likewise RAS and LAS; other names as they are, in small letters.
std::string space_name(std::string_view name);

}  // namespace deliso
