// The field whose isosurface is meshed: that of the volume as it is, or made of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "delaunay/base/vec3.h"
#include "volume/filters/closing.h"
#include "volume/scalar_grid.h"

namespace deliso {

// What is made of a volume, in this order.
struct FieldParameters {
  std::optional<std::int32_t> label;  // 1 where the samples have this value, else 0; the isovalue is then 0.5
  std::optional<double> smooth;       // standard deviation of a Gaussian, in smallest spacings; > 0
  bool invert = false;                // inside is below the isovalue: triangles face higher values
};

inline Inside inside_of(const FieldParameters& parameters) {
  return parameters.invert ? Inside::kBelow : Inside::kAbove;
}

struct MeshedField {
  ScalarGrid grid;
  double isovalue = 0;
};

// The field and its isovalue, closed along the box when `is_closed`. `spacing` is that of the mesher, in which sigma
// counts. Copies no samples when there is nothing to do. Throws InputError when no sample has the label, sigma cannot
// be used, or the isosurface has no point.
MeshedField meshed_field(const ScalarGrid& grid, double isovalue, const FieldParameters& parameters, bool is_closed,
                         const Vec3& spacing, int threads);

// Of which field a certificate is: "label 2, smoothed (sigma 1 voxel), inside below the isovalue"; empty for the volume
// as it is.
std::string field_text(const FieldParameters& parameters);

}  // namespace deliso
