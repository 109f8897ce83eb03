#include "volume/io/base/volume_header.h"

#include "delaunay/base/check.h"

namespace deliso {

VolumeHeader header_of(const ScalarGrid& grid) {
  return {grid.dims(), sample_type(grid.samples()), grid.spacing(), grid.origin()};
}

void for_each_piece(const VolumeHeader& header, const SampleSource& next,
                    const std::function<void(const Samples&)>& f) {
  const std::size_t count = checked_sample_count(header.dims);
  for (std::size_t done = 0; done < count;) {
    const Samples piece = next();
    const std::size_t size = visit_samples(piece, [](const auto& samples) { return samples.size(); });
    DELISO_CHECK(sample_type(piece) == header.type && size > 0 && size <= count - done,
                 "the pieces of a volume have its type and add up to it");
    f(piece);
    done += size;
  }
}

}  // namespace deliso
