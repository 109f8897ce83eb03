// Several numbers side by side (lanes), for steps that are the same for several triangles, lines or cells. A loop over
// all lanes whose body has no branch becomes vector instructions. Each lane gets bit for bit the result that the same
// operations give alone.
#pragma once

#include <array>
#include <cstddef>

#include "delaunay/base/vec3.h"

namespace deliso {

inline constexpr std::size_t kLanes = 4;

struct alignas(kLanes * sizeof(double)) Lanes : std::array<double, kLanes> {};

// A vector in each lane.
struct Vec3Lanes {
  Lanes x{}, y{}, z{};
  [[nodiscard]] Vec3 at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};

// One of two vectors, without a branch.
inline Vec3 choose(bool first, const Vec3& a, const Vec3& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

#if defined(__x86_64__) && defined(__GNUC__)

template <class Step, class... Arguments>
[[gnu::target("avx2")]] void run_in_wide_registers(Arguments&... arguments) {
  Step::run(arguments...);
}

// Runs Step::run(arguments...), a static function that is always inlined and loops over lanes. At run time this chooses
// registers as wide as all lanes where the processor has them, and else registers of two numbers, which every processor
// has.
template <class Step, class... Arguments>
void run_in_lanes(Arguments&... arguments) {
  static const bool kHasWideRegisters = __builtin_cpu_supports("avx2") != 0;
  if (kHasWideRegisters) {
    run_in_wide_registers<Step>(arguments...);
  } else {
    Step::run(arguments...);
  }
}

#else

template <class Step, class... Arguments>
void run_in_lanes(Arguments&... arguments) {
  Step::run(arguments...);
}

#endif

}  // namespace deliso
