#include "experiments/results/plot_bars.h"

#include <algorithm>
#include <numeric>

#include "experiments/results/plot_axis.h"
#include "experiments/results/plot_legend.h"
#include "experiments/results/plot_style.h"
#include "experiments/results/table.h"

namespace deliso {
namespace {

// The layout, in pixels.
constexpr double kBarsWidth = 520;
constexpr double kBarHeight = 18;
constexpr double kPitch = 26;
constexpr double kBarsTop = 44;
constexpr double kBarsRight = 80;

double whole(const Bar& bar) { return std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0); }

}  // namespace

std::string draw_bars(const BarPlot& plot) {
  // The axis, and the room for names, legend and margins.
  std::vector<double> ends = {0};
  double left = 60;
  for (const Bar& bar : plot.bars) {
    ends.push_back(plot.share ? 100 : whole(bar));
    left = std::max(left, 24 + text_width(bar.name, kNameSize));
  }
  const Axis axis = linear_axis(ends, true);
  std::vector<LegendEntry> legend;
  for (const std::string& name : plot.legend) legend.push_back({name, LegendKey::kBox});
  const double bottom = kBarsTop + kPitch * static_cast<double>(plot.bars.size());
  SvgDrawing drawing(left + kBarsWidth + kBarsRight, bottom + 40 + legend_height(legend, kBarsWidth) + 10);
  drawing.text({left, 24}, plot.title, {kTitleSize, "start", true});

  for (const double tick : axis.ticks()) {
    const double x = left + kBarsWidth * axis.place(tick);
    drawing.line({x, kBarsTop}, {x, bottom}, {kGridColor});
    drawing.text({x, bottom + 16}, tick_text(tick) + (plot.share ? " %" : ""), {kTickSize, "middle"});
  }
  for (std::size_t i = 0; i < plot.bars.size(); ++i) {
    const Bar& bar = plot.bars[i];
    const double y = kBarsTop + kPitch * static_cast<double>(i) + (kPitch - kBarHeight) / 2;
    const double total = whole(bar);
    const double unit = plot.share && total > 0 ? 100 / total : 1;
    drawing.text({left - 8, y + kBarHeight - 5}, bar.name, {kNameSize, "end"});
    double done = 0;
    for (std::size_t part = 0; part < bar.parts.size(); ++part) {
      const double from = left + kBarsWidth * axis.place(done * unit);
      done += bar.parts[part];
      const double to = left + kBarsWidth * axis.place(done * unit);
      drawing.rectangle({from, y}, to - from, kBarHeight, legend_color(part));
    }
    const std::string figure = bar.parts.empty() ? std::string(kNoFigure) : figure_text(total);
    drawing.text({left + kBarsWidth * axis.place(done * unit) + 6, y + kBarHeight - 5}, figure, {kNameSize});
  }
  draw_legend(legend, {left, bottom + 30}, kBarsWidth, drawing);
  return drawing.document();
}

}  // namespace deliso
