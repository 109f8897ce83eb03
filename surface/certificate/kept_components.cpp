#include "surface/certificate/kept_components.h"

#include <cstddef>

namespace deliso {

void keep_components(IsosurfaceTopology& topology, std::span<const std::uint8_t> is_dropped) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < is_dropped.size(); ++c) {
    if (is_dropped[c] == 0) topology.components[kept++] = topology.components[c];
  }
  topology.components.resize(kept);
}

}  // namespace deliso
