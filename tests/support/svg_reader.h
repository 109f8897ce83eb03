// Reads drawings back: the elements of an SVG, their attributes and places, as far as the program writes them.
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "experiments/results/svg.h"

namespace deliso::testing {

// The elements of a name with their attributes as text.
inline std::vector<std::string> elements(const std::string& svg, const std::string& name) {
  std::vector<std::string> found;
  const std::regex pattern("<" + name + "( [^>]*)/?>");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

inline std::string attribute(const std::string& element, const std::string& name) {
  std::smatch match;
  const bool found = std::regex_search(element, match, std::regex(" " + name + "=\"([^\"]*)\""));
  return found ? match[1].str() : "";
}

inline double number(const std::string& element, const std::string& name) {
  return std::stod(attribute(element, name));
}

inline std::vector<SvgPoint> points_of(const std::string& element) {
  std::vector<SvgPoint> points;
  const std::string list = attribute(element, "points");
  const std::regex pattern("([-0-9.]+),([-0-9.]+)");
  for (std::sregex_iterator i(list.begin(), list.end(), pattern), end; i != end; ++i) {
    points.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
  }
  return points;
}

// Every tag is closed in its order and every special character is escaped.
inline bool is_well_formed(const std::string& svg) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z]+)([^<>]*?)(/?)>|([^<>]+)|[<>]");
  for (std::sregex_iterator i(svg.begin(), svg.end(), tag), end; i != end; ++i) {
    const std::smatch& m = *i;
    if (m[5].matched) {
      const std::string text = m[5];
      if (std::regex_search(text, std::regex("&(?!amp;|lt;|gt;)"))) return false;
    } else if (!m[2].matched) {
      return false;
    } else if (m[1].length() > 0) {
      if (open.empty() || open.back() != m[2]) return false;
      open.pop_back();
    } else if (m[4].length() == 0) {
      open.push_back(m[2]);
    }
  }
  return open.empty();
}

}  // namespace deliso::testing
