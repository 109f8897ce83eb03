// "Did you mean ...?": the nearest of some known names, for error messages about unknown ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace deliso {

// The fewest insertions, deletions, replacements of a character and swaps of two neighbours that turn a into b (optimal
// string alignment; Damerau 1964, Levenshtein 1966).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table: of i - 2, i - 1 and i characters of a.
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

// The known name nearest to `name` (the first of equally near ones); empty when nothing is known.
inline std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [name](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  return nearest == known.end() ? std::string() : *nearest;
}

// The end of an error message: `; the nearest is "spacings"`, or nothing when nothing is known.
inline std::string nearest_name_hint(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : "; the nearest known name is \"" + nearest + "\"";
}

}  // namespace deliso
