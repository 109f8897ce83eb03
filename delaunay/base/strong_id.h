// Typed 32-bit indices: one type per kind of element, so that a vertex can never be used where a tetrahedron is meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace deliso {

// An index into the flat arrays of one kind of element. `Tag` only tells kinds apart. The largest value means "none".
template <class Tag>
struct StrongId {
  static constexpr std::uint32_t kNoneValue = 0xFFFFFFFFu;
  std::uint32_t value = kNoneValue;

  constexpr StrongId() = default;
  constexpr explicit StrongId(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}

  [[nodiscard]] constexpr std::size_t index() const { return value; }
  [[nodiscard]] constexpr bool is_none() const { return value == kNoneValue; }
  static constexpr StrongId none() { return StrongId(); }

  friend constexpr bool operator==(StrongId a, StrongId b) { return a.value == b.value; }
  friend constexpr bool operator!=(StrongId a, StrongId b) { return a.value != b.value; }
  friend constexpr bool operator<(StrongId a, StrongId b) { return a.value < b.value; }
};

}  // namespace deliso

template <class Tag>
struct std::hash<deliso::StrongId<Tag>> {
  std::size_t operator()(deliso::StrongId<Tag> id) const noexcept { return id.value; }
};
