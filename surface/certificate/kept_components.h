// What is left of an exact topology when some components are left out on purpose.
#pragma once

#include <cstdint>
#include <span>

#include "volume/topology/exact_topology.h"

namespace deliso {

// Takes the dropped components off the list of components, which a mesh is compared with. Crossings and index stay as
// they are, numbered by the whole list. Precondition: one number for each component.
void keep_components(IsosurfaceTopology& topology, std::span<const std::uint8_t> is_dropped);

}  // namespace deliso
