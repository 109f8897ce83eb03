// Small tables of text on a terminal.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace deliso {

// Rows of cells in columns of equal width; the first column is left-aligned, the others right-aligned. With a header,
// the first row is underlined.
class TextTable {
 public:
  TextTable& row(std::vector<std::string> cells);
  void print(std::ostream& stream, bool header = false) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// Shortest text that reads back as about the same number: six significant digits.
std::string number_text(double value);

}  // namespace deliso
