#include "experiments/config/mistakes.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace deliso {
namespace {

// Walks through a document that is known to be JSON and notes the line on which each value begins, by its pointer.
class LineFinder {
 public:
  // `watched`: a key of which the first repetition within an object is noted.
  explicit LineFinder(const std::string& text, std::string watched = "") : text_(text), watched_(std::move(watched)) {
    value("");
  }
  [[nodiscard]] const std::map<std::string, std::size_t>& lines() const { return lines_; }
  [[nodiscard]] const std::optional<JsonPlace>& repeated() const { return repeated_; }

 private:
  void skip_space() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r' || text_[at_] == '\n')) {
      if (text_[at_++] == '\n') ++line_;
    }
  }

  // A string without its quotes; escapes stay as they are written.
  std::string string() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2u : 1u;
    const std::size_t end = std::min(at_, text_.size());
    at_ = end + 1;
    return text_.substr(begin, end - begin);
  }

  // An object or an array: keys or positions, each with its value.
  void members(const std::string& pointer, char close) {
    ++at_;
    for (std::size_t index = 0;; ++index) {
      skip_space();
      if (at_ >= text_.size()) return;
      if (text_[at_] == close) break;
      std::string key = std::to_string(index);
      const std::size_t line = line_;
      if (close == '}') {
        key = string();
        skip_space();
        ++at_;  // the colon
      }
      const std::string inner = std::string(pointer).append("/").append(key);
      if (close == '}' && key == watched_ && !repeated_ && lines_.contains(inner)) repeated_ = JsonPlace{inner, line};
      value(inner);
      if (close == '}') lines_[inner] = line;  // where the key stands
      skip_space();
      if (at_ < text_.size() && text_[at_] == ',') ++at_;
    }
    ++at_;
  }

  void value(const std::string& pointer) {
    skip_space();
    if (at_ >= text_.size()) return;
    lines_[pointer] = line_;
    if (text_[at_] == '{' || text_[at_] == '[') {
      members(pointer, text_[at_] == '{' ? '}' : ']');
    } else if (text_[at_] == '"') {
      string();
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
  }

  const std::string& text_;
  const std::string watched_;
  std::optional<JsonPlace> repeated_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::map<std::string, std::size_t> lines_;
};

// The longest pointer with which the text begins and after which a sentence goes on, or a key that is not there.
std::string pointer_at_start(const std::string& text, const std::map<std::string, std::size_t>& lines) {
  std::string longest;
  for (const auto& [pointer, line] : lines) {
    if (pointer.size() <= longest.size() || !text.starts_with(pointer)) continue;
    const char next = pointer.size() < text.size() ? text[pointer.size()] : ' ';
    if (next == ' ' || next == ':' || (next == '/' && !pointer.empty())) longest = pointer;
  }
  return longest;
}

// The line of a sentence's position, put behind it. For an unknown key it is the key's own line.
std::string numbered(std::string sentence, const std::string& source, const LineFinder& finder) {
  if (!sentence.starts_with(source)) return sentence;
  const std::size_t begin = source.size() + (sentence.starts_with(source + "#") ? 1 : 0);
  const std::string pointer = pointer_at_start(sentence.substr(begin), finder.lines());
  const std::string rest = sentence.substr(begin + pointer.size());
  constexpr std::string_view kUnknown = ": unknown key '";
  auto line = finder.lines().find(pointer);
  if (rest.starts_with(kUnknown)) {
    const std::string key = rest.substr(kUnknown.size(), rest.find('\'', kUnknown.size()) - kUnknown.size());
    line = finder.lines().find(std::string(pointer).append("/").append(key));
  } else if (pointer.empty()) {
    return sentence;  // it is about the whole file
  }
  if (line == finder.lines().end()) return sentence;
  const std::size_t end = std::min(sentence.find_first_of(" :", begin + pointer.size()), sentence.size());
  return sentence.insert(end, " (line " + std::to_string(line->second) + ")");
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n") + sentence;
  return text;
}

void throw_each(std::vector<std::string> sentences) {
  if (sentences.size() == 1) throw InputError(sentences.front());
  if (!sentences.empty()) throw SeveralMistakes(std::move(sentences));
}

}  // namespace

std::optional<JsonPlace> place_of_repeated(const std::string& key, const std::string& text) {
  return LineFinder(text, key).repeated();
}

SeveralMistakes::SeveralMistakes(std::vector<std::string> sentences)
    : InputError(joined(sentences)), sentences_(std::move(sentences)) {}

void Mistakes::add(const InputError& error) {
  const auto add_sentence = [this](const std::string& sentence) {
    if (std::find(sentences_.begin(), sentences_.end(), sentence) == sentences_.end()) sentences_.push_back(sentence);
  };
  const auto* const several = dynamic_cast<const SeveralMistakes*>(&error);
  if (several == nullptr) return add_sentence(error.what());
  for (const std::string& sentence : several->sentences()) add_sentence(sentence);
}

void Mistakes::throw_all() const { throw_each(sentences_); }

void Mistakes::throw_all(const std::string& source, const std::string& text) const {
  if (sentences_.empty()) return;
  const LineFinder finder(text);
  std::vector<std::string> sentences;
  sentences.reserve(sentences_.size());
  for (const std::string& sentence : sentences_) sentences.push_back(numbered(sentence, source, finder));
  throw_each(std::move(sentences));
}

}  // namespace deliso
