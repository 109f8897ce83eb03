// All that is wrong with a document, gathered so that its author is told at once.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

// Several mistakes at once. what() has a line for each.
class SeveralMistakes : public InputError {
 public:
  explicit SeveralMistakes(std::vector<std::string> sentences);
  [[nodiscard]] const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  std::vector<std::string> sentences_;
};

// A place in a document that is known to be JSON.
struct JsonPlace {
  std::string pointer;
  std::size_t line = 0;
};
// Where the key, as it is written, first stands in an object that has it already.
std::optional<JsonPlace> place_of_repeated(const std::string& key, const std::string& text);

class Mistakes {
 public:
  // Each sentence is kept once.
  void add(const InputError& error);
  // Does a step; a mistake that it throws is kept. Returns whether there was none.
  template <class Step>
  bool gather(Step&& step) {
    try {
      std::forward<Step>(step)();
      return true;
    } catch (const InputError& error) {
      add(error);
      return false;
    }
  }
  [[nodiscard]] bool empty() const { return sentences_.empty(); }
  // Throws InputError where there is one mistake, SeveralMistakes where there are more. Does nothing without any.
  void throw_all() const;
  // The same with the lines of a document: behind every position "SOURCE#/json/pointer" with which a sentence begins,
  // "a.json#/metrics/2/value (line 31) names no figure ...". `text` is the document, known to be JSON.
  void throw_all(const std::string& source, const std::string& text) const;

 private:
  std::vector<std::string> sentences_;
};

}  // namespace deliso
