// Numbers side by side, for steps that are the same for several triangles, lines or cells. A loop over all lanes whose
// body has no branch becomes vector instructions; each lane gets what the same operations give alone, to the last bit.
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

// Step::run(arguments...), a static function that is always inlined and loops over lanes: in registers as wide as all
// lanes where the processor has them, chosen when the program runs, or else in those of two numbers that all have.
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
