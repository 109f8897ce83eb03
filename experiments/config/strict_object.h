// One JSON object, read strictly: a table of its keys says what it may hold, and gives its schema.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/config/mistakes.h"

namespace deliso {

enum class KeyType { kText, kNumber, kInteger, kBoolean, kObject, kArray, kAny };

// A key that an object may hold.
struct KeyInfo {
  std::string_view name;
  KeyType type = KeyType::kAny;
  bool required = false;
  std::string_view effect;  // one phrase
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::span<const std::string_view> choices{};  // of a text; empty: any text that is not empty
};

// A key whose value is one of a few texts.
constexpr KeyInfo choice_key(std::string_view name, std::string_view effect, std::span<const std::string_view> choices,
                             bool required = false) {
  KeyInfo key{name, KeyType::kText, required, effect};
  key.choices = choices;
  return key;
}

// An object whose keys are those of a table. The object read from must outlive it.
class StrictObject {
 public:
  // `place` names the object in messages: the file, '#' and the JSON pointer, which is empty for a whole file. Throws
  // InputError when `value` is no object, has a key that the table does not name (the message gives the nearest), lacks
  // a required one, or has a value of the wrong type or out of range. All such mistakes are told at once. With
  // `mistakes` they are added there instead; then keys with a wrong value count as absent, and so may required ones be.
  StrictObject(const Json& value, std::string place, std::span<const KeyInfo> keys, Mistakes* mistakes = nullptr);

  // The position of a key's value in the file.
  [[nodiscard]] std::string place_of(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const;
  // The value of a key. Precondition: has(key).
  [[nodiscard]] const Json& at(std::string_view key) const { return value_->at(std::string(key)); }
  // The value of a key, or `otherwise` without it. Precondition: T fits the key's type.
  template <class T>
  [[nodiscard]] T get(std::string_view key, T otherwise) const {
    return has(key) ? at(key).get<T>() : otherwise;
  }
  // Throws InputError: "<place of key> <sentence>".
  [[noreturn]] void fail(std::string_view key, const std::string& sentence) const;

 private:
  // The position of the object itself; for a whole file its name alone.
  [[nodiscard]] std::string own_place() const;
  void check_keys(std::span<const KeyInfo> keys, Mistakes& found);

  const Json* value_;
  std::string place_;
  std::vector<std::string> refused_;  // keys with a wrong value
};

// JSON text for a message: on one line, cut off when long.
std::string short_json(const Json& value);

// The schema of an object with these keys; the caller may replace the schema of a key afterwards.
Json keys_schema(std::span<const KeyInfo> keys);

}  // namespace deliso
