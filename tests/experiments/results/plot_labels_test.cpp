// Names of y axes that are longer than their panels are tall.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "experiments/results/plot_panels.h"
#include "experiments/results/svg.h"
#include "tests/support/svg_reader.h"

namespace deliso::testing {
namespace {

TEST(PlotLabels, LongNamesOfAxesDoNotOverlap) {
  PanelGrid grid;
  grid.title = "t";
  grid.x_label = "vertices";
  grid.columns = {"A"};
  grid.y_labels = {"mesh to surface, mean (voxels)", "surface samples to mesh, mean (voxels)",
                   "surface samples to mesh, max (voxels)", "short"};
  for (std::size_t row = 0; row < grid.y_labels.size(); ++row)
    grid.panels.push_back({PlotLine{0, {PlotPoint{1, 1, 1, 1}, PlotPoint{2, 3, 3, 3}}}});
  grid.legend = {"one"};
  const std::string svg = draw_panels(grid);
  // The rotated texts by their columns: where each begins and ends along the axis.
  std::map<double, std::vector<std::pair<double, double>>> columns;
  const std::regex text("<text( [^>]*rotate[^>]*)>([^<]*)</text>");
  std::size_t count = 0;
  for (std::sregex_iterator match(svg.begin(), svg.end(), text), end; match != end; ++match, ++count) {
    const double half = text_width((*match)[2].str(), number((*match)[1], "font-size")) / 2;
    const double middle = number((*match)[1], "y");
    columns[number((*match)[1], "x")].push_back({middle - half, middle + half});
    EXPECT_LE(2 * half, 185);
  }
  EXPECT_EQ(count, 7u);  // the third needs two lines, too
  for (auto& [x, parts] : columns) {
    std::sort(parts.begin(), parts.end());
    for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_LE(parts[i - 1].second, parts[i].first) << x;
  }
}

}  // namespace
}  // namespace deliso::testing
