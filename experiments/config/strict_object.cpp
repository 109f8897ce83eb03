#include "experiments/config/strict_object.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"

namespace deliso {
namespace {

std::string_view type_name(KeyType type) {
  switch (type) {
    case KeyType::kText:
      return "string";
    case KeyType::kNumber:
      return "number";
    case KeyType::kInteger:
      return "integer";
    case KeyType::kBoolean:
      return "boolean";
    case KeyType::kObject:
      return "object";
    case KeyType::kArray:
      return "array";
    case KeyType::kAny:
      return "";
  }
  return "";
}

// Beyond 2^53 doubles cannot distinguish integers.
constexpr double kLargestInteger = 0x1p53;

bool in_range(const KeyInfo& key, const Json& value) {
  const auto number = value.get<double>();
  return std::isfinite(number) && key.low <= number && number <= key.high;
}

// Compared as an integer: as a double 2^53 + 1 is 2^53.
bool is_distinct_integer(const Json& value) {
  if (!value.is_number_integer()) return false;
  constexpr auto kMost = static_cast<std::int64_t>(kLargestInteger);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>() <= std::uint64_t{kMost};
  return value.get<std::int64_t>() >= -kMost && value.get<std::int64_t>() <= kMost;
}

bool fits(const KeyInfo& key, const Json& value) {
  switch (key.type) {
    case KeyType::kText: {
      if (!value.is_string()) return false;
      const auto& text = value.get_ref<const std::string&>();
      if (key.choices.empty()) return !text.empty();
      return std::find(key.choices.begin(), key.choices.end(), text) != key.choices.end();
    }
    case KeyType::kNumber:
      return value.is_number() && in_range(key, value);
    case KeyType::kInteger:
      return is_distinct_integer(value) && in_range(key, value);
    case KeyType::kBoolean:
      return value.is_boolean();
    case KeyType::kObject:
      return value.is_object();
    case KeyType::kArray:
      return value.is_array() && !value.empty();
    case KeyType::kAny:
      return true;
  }
  return false;
}

std::string bound_text(double bound) {
  const bool whole = bound == std::floor(bound) && std::abs(bound) <= kLargestInteger;
  return whole ? Json(static_cast<std::int64_t>(bound)).dump() : Json(bound).dump();
}

// "an integer from 1 to 1000", "one of 'mesh', 'topology'".
std::string expected(const KeyInfo& key) {
  if (!key.choices.empty()) {
    std::string text;
    for (const std::string_view choice : key.choices) {
      text += (text.empty() ? "one of '" : ", '") + std::string(choice) + "'";
    }
    return text;
  }
  const std::string_view name = type_name(key.type);
  std::string text = (name.find_first_of("aeiou") == 0 ? "an " : "a ") + std::string(name);
  if (key.type == KeyType::kText || key.type == KeyType::kArray) text += " that is not empty";
  if (std::isfinite(key.low)) text += " from " + bound_text(key.low);
  if (std::isfinite(key.high)) text += " to " + bound_text(key.high);
  return text;
}

}  // namespace

std::string short_json(const Json& value) {
  constexpr std::size_t kLongest = 60;
  std::string text = json_line(value);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + " ...";
  return text;
}

StrictObject::StrictObject(const Json& value, std::string place, std::span<const KeyInfo> keys, Mistakes* mistakes)
    : value_(&value), place_(std::move(place)) {
  Mistakes found;
  if (!value.is_object()) {
    found.add(InputError(own_place() + " must be an object, found " + short_json(value)));
    static const Json kEmpty = Json::object();
    value_ = &kEmpty;
  }
  check_keys(keys, found);
  if (mistakes == nullptr) {
    found.throw_all();
  } else {
    mistakes->gather([&found] { found.throw_all(); });
  }
}

void StrictObject::check_keys(std::span<const KeyInfo> keys, Mistakes& found) {
  // Every key of the object must be known and have a value that the table allows ...
  std::vector<std::string> known;
  for (const KeyInfo& key : keys) known.emplace_back(key.name);
  for (const auto& [name, held] : value_->items()) {
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&known_name = name](const KeyInfo& k) { return k.name == known_name; });
    if (key == keys.end()) {
      found.add(InputError(own_place() + ": unknown key '" + name + "', the nearest known key is '" +
                           nearest_name(name, known) + "'"));
    } else if (!fits(*key, held)) {
      found.add(InputError(place_of(name) + " must be " + expected(*key) + ", found " + short_json(held)));
      refused_.push_back(name);
    }
  }
  // ... and every required one must be there.
  if (value_->empty() && !found.empty()) return;  // it is no object
  for (const KeyInfo& key : keys) {
    if (key.required && !value_->contains(key.name)) {
      found.add(InputError(own_place() + ": the key '" + std::string(key.name) + "' is missing (" +
                           std::string(key.effect) + ")"));
    }
  }
}

bool StrictObject::has(std::string_view key) const {
  return value_->contains(key) && std::find(refused_.begin(), refused_.end(), key) == refused_.end();
}

std::string StrictObject::own_place() const {
  return place_.ends_with('#') ? place_.substr(0, place_.size() - 1) : place_;
}

std::string StrictObject::place_of(std::string_view key) const { return place_ + "/" + std::string(key); }

void StrictObject::fail(std::string_view key, const std::string& sentence) const {
  throw InputError(place_of(key) + " " + sentence);
}

Json keys_schema(std::span<const KeyInfo> keys) {
  Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const KeyInfo& key : keys) {
    Json& property = schema["properties"][std::string(key.name)] = Json::object();
    if (key.type != KeyType::kAny) property["type"] = type_name(key.type);
    if (!key.choices.empty()) property["enum"] = key.choices;
    if (key.type == KeyType::kText && key.choices.empty()) property["minLength"] = 1;
    if (key.type == KeyType::kArray) property["minItems"] = 1;
    if (std::isfinite(key.low)) property["minimum"] = key.low;
    if (std::isfinite(key.high)) property["maximum"] = key.high;
    property["description"] = key.effect;
    if (key.required) required.push_back(key.name);
  }
  if (!required.empty()) schema["required"] = required;
  return schema;
}

}  // namespace deliso
