// What is written of a volume: a header, and samples whole or piece by piece.
#pragma once

#include <functional>

#include "volume/sample_type.h"
#include "volume/scalar_grid.h"

namespace deliso {

// How the samples of an .nrrd file are stored. Raw ones can be mapped into memory when they are read.
enum class NrrdEncoding { kRaw, kGzip };

// What a file says about a volume besides its samples.
struct VolumeHeader {
  Dims dims{};
  SampleType type = SampleType::kU8;
  Vec3 spacing{1, 1, 1};
  Vec3 origin{0, 0, 0};
};
VolumeHeader header_of(const ScalarGrid& grid);

// Gives the next samples of a volume in their order, some more at every call, until all are there.
using SampleSource = std::function<Samples()>;

// Calls `f` with every piece. Throws InternalError when the pieces are of another type or do not add up to the header's
// dimensions.
void for_each_piece(const VolumeHeader& header, const SampleSource& next, const std::function<void(const Samples&)>& f);

}  // namespace deliso
