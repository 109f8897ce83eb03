#include "experiments/json.h"

#include <set>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/files.h"

namespace deliso {
namespace {

// What the parser says, without its own name for the error: "[json.exception.parse_error.101] parse error at ...".
std::string explanation(const nlohmann::json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

// Refuses a key that the object at the same depth already has. (The parser itself would keep the last one.)
class DuplicateKeyCheck {
 public:
  explicit DuplicateKeyCheck(std::string source) : source_(std::move(source)) {}

  bool operator()(int /*depth*/, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key && !keys_.back().insert(parsed.get<std::string>()).second) {
      throw InputError(source_ + ": the key '" + parsed.get<std::string>() + "' stands twice in one object");
    }
    return true;
  }

 private:
  std::string source_;
  std::vector<std::set<std::string>> keys_;  // of the objects that are still open
};

}  // namespace

Json parse_json(const std::string& text, const std::string& source) {
  DuplicateKeyCheck check(source);
  try {
    return Json::parse(text, [&check](int depth, Json::parse_event_t event, const Json& parsed) {
      return check(depth, event, parsed);
    });
  } catch (const nlohmann::json::exception& error) {
    throw InputError(source + ": not valid JSON, " + explanation(error));
  }
}

Json read_json(const std::filesystem::path& path) { return parse_json(read_text(path), path.string()); }

std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace deliso
