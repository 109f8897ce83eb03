#include "experiments/lesson/columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "experiments/lesson/packed_text.h"

namespace deliso {
namespace {

using Values = std::vector<const Json*>;

constexpr double kScale = 1e5;                   // digits behind the point that coordinates have
constexpr double kLargestValue = 1'000'000'000;  // so that twice of it has 32 bits
constexpr std::size_t kMostParts = 4;

bool are_all(const Values& values, const auto& predicate) {
  return std::all_of(values.begin(), values.end(), [&](const Json* value) { return predicate(*value); });
}

std::string text_of_ints(const std::vector<std::int64_t>& ints) {
  std::vector<std::uint32_t> codes;
  std::uint32_t largest = 0;
  for (const std::int64_t k : ints) {
    codes.push_back(static_cast<std::uint32_t>(k < 0 ? -2 * k - 1 : 2 * k));
    largest = std::max(largest, codes.back());
  }
  int bytes_each = 1;
  while (bytes_each < 4 && (largest >> (8 * bytes_each)) != 0) ++bytes_each;
  std::vector<unsigned char> bytes;
  for (int k = 0; k < bytes_each; ++k) {
    for (const std::uint32_t code : codes) bytes.push_back(static_cast<unsigned char>(code >> (8 * k)));
  }
  return std::to_string(bytes_each) + base64(bytes);
}

bool is_int(const Json& value) { return value.is_number_integer() && std::abs(value.get<double>()) <= kLargestValue; }

bool is_scaled(const Json& value) {
  if (!value.is_number()) return false;
  const double scaled = value.get<double>() * kScale;
  return std::abs(scaled) <= kLargestValue && std::abs(scaled - std::nearbyint(scaled)) < 1e-6;
}

Json column_of(const Values& values);

Json column_of_arrays(const Values& arrays) {
  const std::size_t parts = arrays.front()->size();
  const bool is_equal = are_all(arrays, [&](const Json& array) { return array.size() == parts; });
  if (is_equal && parts > 0 && parts <= kMostParts) {
    Json columns = Json::array();
    for (std::size_t i = 0; i < parts; ++i) {
      Values column;
      for (const Json* array : arrays) column.push_back(&(*array)[i]);
      columns.push_back(column_of(column));
    }
    return {{"parts", std::move(columns)}};
  }
  Json sizes = Json::array();
  Values items, size_values;
  for (const Json* array : arrays) {
    sizes.push_back(array->size());
    for (const Json& item : *array) items.push_back(&item);
  }
  for (const Json& size : sizes) size_values.push_back(&size);
  return {{"sizes", column_of(size_values)}, {"items", column_of(items)}};
}

Json column_of(const Values& values) {
  if (values.size() > 1 && are_all(values, [&](const Json& value) { return value == *values.front(); }))
    return {{"same", *values.front()}};
  if (!values.empty() && are_all(values, [](const Json& value) { return value.is_array(); }))
    return column_of_arrays(values);
  const bool are_ints = are_all(values, is_int);
  if (!values.empty() && (are_ints || are_all(values, is_scaled))) {
    std::vector<std::int64_t> ints;
    for (const Json* value : values) {
      ints.push_back(static_cast<std::int64_t>(std::nearbyint(value->get<double>() * (are_ints ? 1 : kScale))));
    }
    if (are_ints) return {{"ints", text_of_ints(ints)}};
    return {{"scaled", kScale}, {"ints", text_of_ints(ints)}};
  }
  Json plain = Json::array();
  for (const Json* value : values) plain.push_back(*value);
  return {{"values", std::move(plain)}};
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

}  // namespace

Json list_of_values(const Json& values) {
  Values all;
  for (const Json& value : values) all.push_back(&value);
  return {{"count", values.size()}, {"column", column_of(all)}};
}

Json list_of_objects(const Json& objects) {
  std::vector<std::vector<std::string>> kinds;
  std::vector<Values> members;
  Json order = Json::array();
  for (const Json& object : objects) {
    std::vector<std::string> keys = keys_of(object);
    const auto found = std::find(kinds.begin(), kinds.end(), keys);
    const auto kind = static_cast<std::size_t>(found - kinds.begin());
    if (found == kinds.end()) {
      kinds.push_back(std::move(keys));
      members.emplace_back();
    }
    order.push_back(kind);
    members[kind].push_back(&object);
  }
  Json lists = Json::array();
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    Json columns = Json::object();
    for (const std::string& key : kinds[kind]) {
      Values column;
      for (const Json* object : members[kind]) column.push_back(&object->at(key));
      columns[key] = column_of(column);
    }
    lists.push_back({{"count", members[kind].size()}, {"columns", std::move(columns)}});
  }
  return {{"order", list_of_values(order)}, {"kinds", std::move(lists)}};
}

}  // namespace deliso
