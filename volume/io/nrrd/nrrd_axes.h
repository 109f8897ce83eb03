// Which axes of an NRRD file are those of the volume, and where they lead.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "volume/affine.h"
#include "volume/io/nrrd/nrrd_fields.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Of all axes of the file three follow each other that are the volume's x, y, z. Those before count values of each
// place, those after volumes.
struct NrrdAxes {
  std::size_t count = 0;  // axes in the file
  std::size_t first = 0;  // the axis x; y and z follow
  Dims dims{};
  std::uint64_t components = 1;
  std::uint64_t volumes = 1;
};

// The volume's axes are those with a direction (`space directions`), else those whose kind is one of space or domain,
// else, of four, all but one of a single sample, else all but the last (but the first when it is shorter).
NrrdAxes read_nrrd_axes(const NrrdFields& fields);

// From the index of a sample to the world: `space directions` and `space origin`, or `spacings`, `axis mins` and `axis
// maxs`.
Affine read_nrrd_geometry(const NrrdFields& fields, const NrrdAxes& axes);

}  // namespace deliso
