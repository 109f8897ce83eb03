// JSON as the library writes it: what a report holds, in the order in which it was put there.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// A value of JSON: null, a plain value, an array or an object.
class JsonTree {
 public:
  using Member = std::pair<std::string_view, JsonTree>;

  // The conversions are implicit, so that a report reads as what it gives.
  // NOLINTBEGIN(google-explicit-constructor)
  JsonTree() = default;  // null
  JsonTree(bool value) : text_(value ? "true" : "false") {}
  template <std::integral Whole>
  JsonTree(Whole value) : text_(std::to_string(value)) {}
  JsonTree(double value);  // null where it is not finite
  JsonTree(std::string_view value);
  JsonTree(const std::string& value) : JsonTree(std::string_view(value)) {}
  JsonTree(const char* value) : JsonTree(std::string_view(value)) {}
  JsonTree(const Vec3& p) : JsonTree(std::array{p.x, p.y, p.z}) {}
  template <class T>
  JsonTree(const std::optional<T>& value) : JsonTree(value ? JsonTree(*value) : JsonTree()) {}
  template <class T>
  JsonTree(const std::vector<T>& values) : kind_(Kind::kArray) {
    for (const T& value : values) push_back(value);
  }
  template <class T, std::size_t kCount>
  JsonTree(const std::array<T, kCount>& values) : kind_(Kind::kArray) {
    for (const T& value : values) push_back(value);
  }
  JsonTree(std::initializer_list<Member> members);  // an object
  // NOLINTEND(google-explicit-constructor)

  static JsonTree array() { return JsonTree(std::vector<int>()); }

  // The value of a key, null at first. Precondition: an object or null.
  JsonTree& operator[](std::string_view key);
  // Precondition: an array.
  void push_back(JsonTree value) { members_.emplace_back(std::string(), std::move(value)); }

  // Adds the members of another object. Precondition: both are objects without common keys.
  void update(JsonTree other) {
    for (auto& member : other.members_) members_.push_back(std::move(member));
  }

  // With an indentation of two spaces, and no line end after it.
  [[nodiscard]] std::string text(int depth = 0) const;

 private:
  enum class Kind : std::uint8_t { kPlain, kArray, kObject };

  Kind kind_ = Kind::kPlain;
  std::string text_ = "null";                              // of a plain value, as it is written
  std::vector<std::pair<std::string, JsonTree>> members_;  // in an array without keys
};

}  // namespace deliso
