// A grid of panels with lines in them: curves and histograms. Panels of a column share the x axis, and panels of a row
// the y axis, so that they can be compared.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/results/plot_axis.h"

namespace deliso {

// A point of a line, with the spread of its value.
struct PlotPoint {
  double x = 0;
  double y = 0;
  double low = 0;
  double high = 0;
};

// One line of a panel. A line of one point is a mark.
struct PlotLine {
  std::size_t legend = 0;  // its entry in the legend, which gives its colour
  std::vector<PlotPoint> points;
};

struct PanelGrid {
  std::string title;
  std::vector<std::string> columns;   // what stands above each column
  std::vector<std::string> y_labels;  // of each row
  std::string x_label;
  AxisScale x_scale = AxisScale::kLinear;
  AxisScale y_scale = AxisScale::kLinear;
  bool marks = true;        // a mark at every point of a line
  bool y_from_zero = true;  // of linear axes
  std::vector<std::string> legend;
  std::vector<std::vector<PlotLine>> panels;  // row by row: panels[row * columns.size() + column]
};

// As SVG. On logarithmic axes values that are not positive are left out.
std::string draw_panels(const PanelGrid& grid);

}  // namespace deliso
