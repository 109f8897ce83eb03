#include "experiments/system/text_table.h"

#include <algorithm>
#include <sstream>

namespace deliso {

TextTable& TextTable::row(std::vector<std::string> cells) {
  rows_.push_back(std::move(cells));
  return *this;
}

void TextTable::print(std::ostream& stream, bool header) const {
  std::vector<std::size_t> widths;
  for (const auto& cells : rows_) {
    widths.resize(std::max(widths.size(), cells.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], cells[c].size());
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::string line;
    std::string rule;
    for (std::size_t c = 0; c < rows_[r].size(); ++c) {
      const std::string padding(widths[c] - rows_[r][c].size(), ' ');
      if (c > 0) line.append("  ").append(padding).append(rows_[r][c]);
      if (c == 0) line.append(rows_[r][c]).append(padding);
      if (c > 0) rule.append("  ");
      rule.append(widths[c], '-');
    }
    stream << line << '\n';
    if (header && r == 0) stream << rule << '\n';
  }
}

std::string number_text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

}  // namespace deliso
