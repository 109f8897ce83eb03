#include "experiments/results/plot_panels.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/results/plot_legend.h"
#include "experiments/results/plot_style.h"

namespace deliso {
namespace {

// The layout, in pixels.
constexpr double kPanelWidth = 250;
constexpr double kPanelHeight = 180;
constexpr double kGap = 22;
constexpr double kLeft = 78;
constexpr double kRight = 22;
constexpr double kTop = 62;
constexpr double kBottom = 46;
constexpr std::string_view kFrameColor = "#888888";

bool is_shown(const PanelGrid& grid, const PlotPoint& p) {
  if (grid.x_scale == AxisScale::kLog && !(p.x > 0)) return false;
  return grid.y_scale == AxisScale::kLinear || p.y > 0;
}

// A text in lines of at most this width, broken at blanks; a longer word has a line of its own.
std::vector<std::string> lines_of(const std::string& text, double width, double size) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    std::string longer = line;
    if (!line.empty()) longer += ' ';
    longer += word;
    if (!line.empty() && text_width(longer, size) > width) {
      lines.push_back(word);
    } else {
      line = std::move(longer);
    }
  }
  return lines;
}

class PanelDrawer {
 public:
  explicit PanelDrawer(const PanelGrid& grid)
      : grid_(grid),
        legend_(legend_of(grid)),
        drawing_(width(), legend_top() + legend_height(legend_, legend_width()) + 10) {}

  std::string draw() {
    drawing_.text({kLeft, 24}, grid_.title, {kTitleSize, "start", true});
    for (std::size_t row = 0; row < grid_.y_labels.size(); ++row) {
      for (std::size_t column = 0; column < grid_.columns.size(); ++column) draw_panel(row, column);
    }
    draw_legend(legend_, {kLeft, legend_top()}, legend_width(), drawing_);
    return drawing_.document();
  }

 private:
  static std::vector<LegendEntry> legend_of(const PanelGrid& grid) {
    std::vector<LegendEntry> entries;
    for (const std::string& name : grid.legend) {
      entries.push_back({name, grid.marks ? LegendKey::kMark : LegendKey::kBox});
    }
    for (const auto& panel : grid.panels) {
      for (const PlotLine& line : panel) {
        if (grid.marks && line.points.size() > 1) entries[line.legend].key = LegendKey::kLine;
      }
    }
    return entries;
  }

  [[nodiscard]] double width() const {
    const auto columns = static_cast<double>(grid_.columns.size());
    const double title = 1.1 * text_width(grid_.title, kTitleSize);  // bold
    return kLeft + std::max(columns * kPanelWidth + (columns - 1) * kGap, title) + kRight;
  }
  [[nodiscard]] double legend_width() const { return width() - kLeft - kRight; }
  [[nodiscard]] double legend_top() const {
    const auto rows = static_cast<double>(grid_.y_labels.size());
    return kTop + rows * kPanelHeight + (rows - 1) * kGap + kBottom;
  }
  [[nodiscard]] const std::vector<PlotLine>& panel(std::size_t row, std::size_t column) const {
    return grid_.panels[row * grid_.columns.size() + column];
  }

  // The axis of a column's x or of a row's y.
  Axis axis_of(const std::vector<double>& values, AxisScale scale, bool from_zero) const {
    return scale == AxisScale::kLog ? log_axis(values) : linear_axis(values, from_zero);
  }
  Axis x_axis(std::size_t column) const {
    std::vector<double> values;
    for (std::size_t row = 0; row < grid_.y_labels.size(); ++row) {
      for (const PlotLine& line : panel(row, column)) {
        for (const PlotPoint& p : line.points) values.push_back(p.x);
      }
    }
    return axis_of(values, grid_.x_scale, true);
  }
  Axis y_axis(std::size_t row) const {
    std::vector<double> values;
    for (std::size_t column = 0; column < grid_.columns.size(); ++column) {
      for (const PlotLine& line : panel(row, column)) {
        for (const PlotPoint& p : line.points) values.insert(values.end(), {p.y, p.low, p.high});
      }
    }
    return axis_of(values, grid_.y_scale, grid_.y_from_zero);
  }

  void draw_panel(std::size_t row, std::size_t column) {
    const SvgPoint corner{kLeft + static_cast<double>(column) * (kPanelWidth + kGap),
                          kTop + static_cast<double>(row) * (kPanelHeight + kGap)};
    const Axis x = x_axis(column);
    const Axis y = y_axis(row);
    draw_frame(row, column, corner, x, y);
    for (const PlotLine& line : panel(row, column)) {
      std::vector<SvgPoint> path;
      for (const PlotPoint& p : line.points) {
        if (!is_shown(grid_, p)) continue;
        path.push_back({corner.x + kPanelWidth * x.place(p.x), corner.y + kPanelHeight * (1 - y.place(p.y))});
        draw_spread(path.back(), p, corner, y, legend_color(line.legend));
      }
      draw_line(path, line);
    }
    if (panel(row, column).empty()) {
      drawing_.text({corner.x + kPanelWidth / 2, corner.y + kPanelHeight / 2}, "no figures", {kNameSize, "middle"});
    }
  }

  void draw_frame(std::size_t row, std::size_t column, SvgPoint corner, const Axis& x, const Axis& y) {
    const double right = corner.x + kPanelWidth;
    const double bottom = corner.y + kPanelHeight;
    for (const double tick : x.ticks()) {
      const double at = corner.x + kPanelWidth * x.place(tick);
      drawing_.line({at, corner.y}, {at, bottom}, {kGridColor});
      if (row + 1 == grid_.y_labels.size()) drawing_.text({at, bottom + 16}, tick_text(tick), {kTickSize, "middle"});
    }
    for (const double tick : y.ticks()) {
      const double at = corner.y + kPanelHeight * (1 - y.place(tick));
      drawing_.line({corner.x, at}, {right, at}, {kGridColor});
      if (column == 0) drawing_.text({corner.x - 6, at + 4}, tick_text(tick), {kTickSize, "end"});
    }
    drawing_.line({corner.x, corner.y}, {corner.x, bottom}, {kFrameColor});
    drawing_.line({corner.x, bottom}, {right, bottom}, {kFrameColor});
    const double middle = corner.x + kPanelWidth / 2;
    if (row == 0) drawing_.text({middle, corner.y - 10}, grid_.columns[column], {13, "middle", true});
    if (row + 1 == grid_.y_labels.size()) drawing_.text({middle, bottom + 34}, grid_.x_label, {kNameSize, "middle"});
    if (column > 0) return;
    // Lines beside each other, left of the ticks.
    const std::vector<std::string> lines = lines_of(grid_.y_labels[row], kPanelHeight, kNameSize);
    constexpr double kMiddle = 22, kLineHeight = 14;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double offset = static_cast<double>(i) - 0.5 * static_cast<double>(lines.size() - 1);
      drawing_.text({kMiddle + kLineHeight * offset, corner.y + kPanelHeight / 2}, lines[i],
                    {kNameSize, "middle", false, true});
    }
  }

  // From the smallest to the largest value of the repeats.
  void draw_spread(SvgPoint at, const PlotPoint& p, SvgPoint corner, const Axis& y, std::string_view color) {
    if (!(p.high > p.low) || (y.scale == AxisScale::kLog && !(p.low > 0))) return;
    drawing_.line({at.x, corner.y + kPanelHeight * (1 - y.place(p.low))},
                  {at.x, corner.y + kPanelHeight * (1 - y.place(p.high))}, {color, 1});
  }

  void draw_line(const std::vector<SvgPoint>& path, const PlotLine& line) {
    const std::string_view color = legend_color(line.legend);
    if (path.size() > 1) drawing_.polyline(path, {color, 1.8});
    if (!grid_.marks) return;
    for (const SvgPoint& at : path) draw_mark(at, line.points.size() == 1, color, drawing_);
  }

  const PanelGrid& grid_;
  std::vector<LegendEntry> legend_;
  SvgDrawing drawing_;
};

}  // namespace

std::string draw_panels(const PanelGrid& grid) { return PanelDrawer(grid).draw(); }

}  // namespace deliso
