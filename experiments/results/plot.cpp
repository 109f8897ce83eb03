#include "experiments/results/plot.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "experiments/results/plot_bars.h"
#include "experiments/results/plot_panels.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

class PlotMaker {
 public:
  PlotMaker(const Experiment& experiment, const Table& table, const std::vector<Json>& records)
      : experiment_(experiment), table_(table), records_(records) {}

  // The plot as SVG; nothing when there is no figure to draw.
  [[nodiscard]] std::optional<std::string> draw(const Plot& plot) const {
    switch (plot.kind) {
      case PlotKind::kCurve:
        return draw_curves(plot);
      case PlotKind::kBars:
        return draw_rows(plot);
      case PlotKind::kHistogram:
        return draw_histogram(plot);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] const Figure& figure(const TableRow& row, const std::string& metric) const {
    std::size_t i = 0;
    while (experiment_.metrics[i].name != metric) ++i;
    return row.cells[i].ours;
  }
  [[nodiscard]] const TableRow* row_of(const std::string& dataset, const std::string& variant) const {
    for (const TableRow& row : table_.rows) {
      if (row.dataset == dataset && row.variant == variant && row.state == RowState::kDone) return &row;
    }
    return nullptr;
  }

  // A line of a curve: medians with their spreads, from left to right.
  [[nodiscard]] std::vector<PlotPoint> points_of(const Plot& plot, const PlotSeries& series, const std::string& panel,
                                                 const std::string& y_metric) const {
    std::vector<PlotPoint> points;
    for (const std::string& member : series.members) {
      const TableRow* row = plot.across_datasets ? row_of(member, panel) : row_of(panel, member);
      if (row == nullptr) continue;
      const Figure& x = figure(*row, plot.x);
      const Figure& y = figure(*row, y_metric);
      if (x.numbers.empty() || y.numbers.empty()) continue;
      points.push_back({x.median(), y.median(), y.numbers.front(), y.numbers.back()});
    }
    std::stable_sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    return points;
  }

  [[nodiscard]] std::optional<std::string> draw_curves(const Plot& plot) const {
    PanelGrid grid;
    grid.title = plot.title;
    grid.x_label = plot.x;
    grid.x_scale = plot.log_x ? AxisScale::kLog : AxisScale::kLinear;
    grid.y_scale = plot.log_y ? AxisScale::kLog : AxisScale::kLinear;
    grid.y_labels = plot.y;
    for (const PlotSeries& series : plot.series) grid.legend.push_back(series.name);
    // One panel for each data set or variant that has figures; the table names the absent ones.
    for (const std::string& panel : panels_of(plot)) {
      const bool has_points = std::any_of(plot.series.begin(), plot.series.end(), [&](const PlotSeries& series) {
        return std::any_of(plot.y.begin(), plot.y.end(),
                           [&](const std::string& y) { return !points_of(plot, series, panel, y).empty(); });
      });
      if (has_points) grid.columns.push_back(panel);
    }
    if (grid.columns.empty()) return std::nullopt;
    for (const std::string& y : plot.y) {
      for (const std::string& panel : grid.columns) {
        std::vector<PlotLine>& lines = grid.panels.emplace_back();
        for (std::size_t i = 0; i < plot.series.size(); ++i) {
          std::vector<PlotPoint> points = points_of(plot, plot.series[i], panel, y);
          if (!points.empty()) lines.push_back({i, std::move(points)});
        }
      }
    }
    return draw_panels(grid);
  }

  [[nodiscard]] std::vector<std::string> panels_of(const Plot& plot) const {
    std::vector<std::string> panels;
    for (const Variant& variant : experiment_.variants) {
      if (plot.across_datasets) panels.push_back(variant.name);
    }
    for (const Dataset& dataset : experiment_.datasets) {
      if (!plot.across_datasets) panels.push_back(dataset.name);
    }
    return panels;
  }

  // A bar for each row of the table that is done.
  [[nodiscard]] std::optional<std::string> draw_rows(const Plot& plot) const {
    BarPlot bars;
    bars.title = plot.title;
    bars.legend = plot.y;
    bars.share = plot.share;
    bool any_figures = false;
    for (const TableRow& row : table_.rows) {
      if (row.state != RowState::kDone) continue;
      Bar bar{row.dataset, {}};
      if (!row.variant.empty() && experiment_.variants.size() > 1) bar.name += ", " + row.variant;
      bool has_figures = false;
      for (const std::string& y : plot.y) {
        const Figure& part = figure(row, y);
        has_figures = has_figures || !part.numbers.empty();
        bar.parts.push_back(part.numbers.empty() ? 0 : std::max(0.0, part.median()));
      }
      // For example, marching cubes has no stages: then there is no bar, instead of one of length 0.
      if (!has_figures) bar.parts.clear();
      any_figures = any_figures || has_figures;
      bars.bars.push_back(std::move(bar));
    }
    if (!any_figures) return std::nullopt;
    return draw_bars(bars);
  }

  // The counts of all repeats added up, in per cent.
  [[nodiscard]] std::vector<double> shares_of(const std::string& dataset, const std::string& variant,
                                              const std::string& path) const {
    std::vector<double> counts;
    for (const Json& record : records_) {
      if (record["status"] != kStatusDone || record["dataset"] != dataset || record["variant"] != variant) continue;
      const Json list = value_at(record, path);
      counts.resize(std::max(counts.size(), list.size()), 0);
      for (std::size_t i = 0; i < list.size(); ++i) counts[i] += list[i].is_number() ? list[i].get<double>() : 0;
    }
    const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
    if (!(sum > 0)) return {};
    for (double& count : counts) count *= 100 / sum;
    return counts;
  }

  [[nodiscard]] std::optional<std::string> draw_histogram(const Plot& plot) const {
    PanelGrid grid;
    grid.title = plot.title;
    grid.x_label = plot.x_label;
    grid.y_labels = {"share (%)"};
    grid.marks = false;
    for (const PlotSeries& series : plot.series) grid.legend.push_back(series.name);
    for (const Dataset& dataset : experiment_.datasets) {
      std::vector<PlotLine> lines;
      for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const std::vector<double> shares = shares_of(dataset.name, plot.series[i].members.front(), plot.value);
        if (shares.empty()) continue;
        lines.push_back({i, outline_of(shares, plot.bin_width)});
      }
      if (lines.empty()) continue;
      grid.columns.push_back(dataset.name);
      grid.panels.push_back(std::move(lines));
    }
    if (grid.columns.empty()) return std::nullopt;
    return draw_panels(grid);
  }

  // The outline of a histogram as steps over the bins, beginning and ending on the axis.
  static std::vector<PlotPoint> outline_of(const std::vector<double>& heights, double bin_width) {
    const auto at = [](double x, double y) { return PlotPoint{x, y, y, y}; };
    std::vector<PlotPoint> outline = {at(0, 0)};
    for (std::size_t i = 0; i < heights.size(); ++i) {
      outline.push_back(at(static_cast<double>(i) * bin_width, heights[i]));
      outline.push_back(at(static_cast<double>(i + 1) * bin_width, heights[i]));
    }
    outline.push_back(at(static_cast<double>(heights.size()) * bin_width, 0));
    return outline;
  }

  const Experiment& experiment_;
  const Table& table_;
  const std::vector<Json>& records_;
};

}  // namespace

std::string svg_name(const Plot& plot) { return plot.name + ".svg"; }

std::vector<PlotFile> draw_plots(const Experiment& experiment, const Table& table, const std::vector<Json>& records) {
  const PlotMaker maker(experiment, table, records);
  std::vector<PlotFile> files;
  for (const Plot& plot : experiment.plots) {
    std::optional<std::string> svg = maker.draw(plot);
    if (svg) files.push_back({svg_name(plot), std::move(*svg)});
  }
  return files;
}

}  // namespace deliso
