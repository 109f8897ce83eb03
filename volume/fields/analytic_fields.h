// Built-in volumes: fields with known answers, hard cases, and a volume to start with.
//
// A field is given on the cube [-1, 1]^3 and sampled at size^3 points, the outermost on the cube's faces; the grid's
// spacing is 1 (voxels) and its origin 0.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// `count` components of the isosurface that are homeomorphic to each other.
struct KnownComponents {
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
  std::int64_t count = 0;
  friend bool operator==(const KnownComponents&, const KnownComponents&) = default;
};

// The value at a point of [-1, 1]^3. It must be called for every sample in order, x fastest, because noise draws its
// values in this order. Each sample is the nearest value of its type.
using FieldValues = std::function<double(const Vec3&)>;

struct AnalyticField {
  std::string name;
  std::string description;  // one line
  std::int32_t default_size = 0;
  double isovalue = 0;    // suggested; for every size and seed no sample equals it
  std::string type_name;  // of the samples, as ScalarGrid::type_name
  bool closed = false;    // does the isosurface at the suggested isovalue stay away from the cube's faces?
  bool seeded = false;    // does the seed matter?
  // The isosurface at the suggested isovalue up to homeomorphism, for sizes from `smallest_known_size` on. Empty when
  // it is not known beforehand or the size is too small to resolve it.
  std::int32_t smallest_known_size = 0;
  std::optional<std::vector<KnownComponents>> (*topology)(std::int32_t size) = nullptr;
  FieldValues (*values)(std::int32_t size, std::uint64_t seed) = nullptr;

  [[nodiscard]] std::optional<std::vector<KnownComponents>> known_topology(std::int32_t size) const {
    return topology == nullptr || size < smallest_known_size ? std::nullopt : topology(size);
  }
};

// All built-in fields, the one to start with first.
const std::vector<AnalyticField>& analytic_fields();

// The field of this name. Throws InputError naming the nearest known name.
const AnalyticField& find_analytic_field(std::string_view name);

}  // namespace deliso
