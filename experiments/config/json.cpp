#include "experiments/config/json.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/config/mistakes.h"
#include "experiments/system/files.h"

namespace deliso {
namespace {

// The parser's message without its name for the error: "[json.exception.parse_error.101] parse error at ...".
std::string explanation(const nlohmann::json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

// "line 3: the number 1e999 is too large": the parser gives the number in quotes, but not its line.
std::string too_large(const nlohmann::json::out_of_range& error, const std::string& text) {
  const std::string message = explanation(error);
  const std::size_t begin = message.find('\'') + 1;
  const std::string number = message.substr(begin, message.rfind('\'') - begin);
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(text.find(number), text.size()));
  return "line " + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": the number " + number + " is too large";
}

// More levels than any document of ours has. What walks through a document calls itself for each level, and its stack
// holds some ten thousand.
constexpr int kDeepest = 500;

// Refuses what is nested too deeply, and notes a key that the object at the same depth already has. (The parser itself
// would keep the last one.)
class StructureCheck {
 public:
  explicit StructureCheck(std::string source) : source_(std::move(source)) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > kDeepest) {
      throw InputError(source_ + ": nested too deeply, expected at most " + std::to_string(kDeepest) +
                       " objects and arrays within each other");
    }
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key && !keys_.back().insert(parsed.get<std::string>()).second && !repeated_) {
      repeated_ = parsed.get<std::string>();
    }
    return true;
  }
  // Throws when a key was repeated. The parser does not tell its line, which is looked for in the whole document.
  void refuse_repeated(const std::string& text) const {
    if (!repeated_) return;
    const std::optional<JsonPlace> place = place_of_repeated(*repeated_, text);
    const std::string where = place ? "#" + place->pointer + " (line " + std::to_string(place->line) + ")" : "";
    throw InputError(source_ + where + ": the key '" + *repeated_ + "' stands twice in one object");
  }

 private:
  std::string source_;
  std::vector<std::set<std::string>> keys_;  // of the objects that are still open
  std::optional<std::string> repeated_;      // the first one
};

}  // namespace

Json parse_json(const std::string& text, const std::string& source) {
  // The parser would take it for the end of the document.
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
    throw InputError(source + ": not valid JSON, line " + std::to_string(1 + lines) + " holds a byte of value 0");
  }
  StructureCheck check(source);
  try {
    Json document = Json::parse(text, [&check](int depth, Json::parse_event_t event, const Json& parsed) {
      return check(depth, event, parsed);
    });
    check.refuse_repeated(text);
    return document;
  } catch (const nlohmann::json::out_of_range& error) {
    throw InputError(source + ": " + too_large(error, text));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(source + ": not valid JSON, " + explanation(error));
  }
}

Json read_json(const std::filesystem::path& path) { return parse_json(read_text(path), path.string()); }

std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string json_line(const Json& document) { return document.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace deliso
