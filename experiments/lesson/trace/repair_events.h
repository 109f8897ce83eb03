// Events of a trace about repair and the certificate (trace_writer.h has the format).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "delaunay/base/vec3.h"
#include "surface/base/observer.h"

namespace deliso {

using TraceEvent = nlohmann::ordered_json;

inline TraceEvent array_of(const Vec3& p) { return TraceEvent::array({p.x, p.y, p.z}); }
TraceEvent array_of(std::span<const Vec3> points);

// `compare`: the mesh, each exact component with its main piece (-1: none) and how they agree, and each piece with one
// of its vertices.
TraceEvent comparison_event(const ObservedComparison& comparison);
// `sample`: each cell once, by the number of its lowest sample along each axis; level 0 is not sampled by the lattice.
TraceEvent sampling_event(const CellLevels& levels, std::span<const std::uint64_t> cells);
// `certify`
TraceEvent certificate_event(const PromiseFigures& figures, const Promise& promise);

}  // namespace deliso
