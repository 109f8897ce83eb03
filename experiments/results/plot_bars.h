// Horizontal bars made of parts, one below the other.
#pragma once

#include <string>
#include <vector>

namespace deliso {

struct Bar {
  std::string name;
  std::vector<double> parts;  // one for each entry of the legend; >= 0; empty if there are no figures (drawn as a dash)
};

struct BarPlot {
  std::string title;
  std::vector<std::string> legend;
  std::vector<Bar> bars;
  bool share = false;  // parts of the bar's whole in per cent; the whole is written beside the bar
};

// As SVG.
std::string draw_bars(const BarPlot& plot);

}  // namespace deliso
