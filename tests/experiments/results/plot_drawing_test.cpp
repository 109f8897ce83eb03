// What plots are drawn of: text and tags, axes, bars, and the room that a title needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "experiments/results/plot_axis.h"
#include "experiments/results/plot_bars.h"
#include "experiments/results/plot_panels.h"
#include "experiments/results/svg.h"
#include "tests/support/svg_reader.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(Svg, TextIsEscapedAndTagsAreClosed) {
  SvgDrawing drawing(100, 50);
  drawing.text({1, 2}, "a < b & c > \"d\"\n", {12, "end", true, true});
  drawing.line({0, 0}, {1.005, -1e-9}, {"#123456", 2});
  const std::string svg = drawing.document();
  EXPECT_TRUE(is_well_formed(svg)) << svg;
  EXPECT_MESSAGE(svg, "a &lt; b &amp; c &gt; \"d\" </text>");
  EXPECT_MESSAGE(svg, "y2=\"0\"");
  EXPECT_MESSAGE(svg, "viewBox=\"0 0 100 50\"");
}

TEST(Axis, TicksAreRoundAscendingAndWithin) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    std::vector<double> values;
    const double scale = std::pow(10, rng.uniform(-8, 8));
    for (int i = 0; i < 4; ++i) values.push_back(scale * std::exp(rng.uniform(-3, 3)));
    for (const Axis& axis : {linear_axis(values, true), linear_axis(values, false), log_axis(values)}) {
      for (const double value : values) {
        EXPECT_GE(axis.place(value), -1e-9);
        EXPECT_LE(axis.place(value), 1 + 1e-9);
      }
      EXPECT_NEAR(axis.place(axis.low), 0, 1e-12);
      EXPECT_NEAR(axis.place(axis.high), 1, 1e-12);
      const std::vector<double> ticks = axis.ticks();
      EXPECT_GE(ticks.size(), 2u);
      EXPECT_LE(ticks.size(), 14u);
      EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
      for (const double tick : ticks) {
        EXPECT_GE(axis.place(tick), -1e-9);
        EXPECT_LE(axis.place(tick), 1 + 1e-9);
        EXPECT_LE(tick_text(tick).size(), 7u) << tick_text(tick);  // short: no 0.30000000000000004
      }
    }
  }
}

TEST(Axis, EqualValuesAndNoValuesGiveAnAxisToo) {
  for (const std::vector<double>& values : {std::vector<double>{}, {0}, {5, 5}, {-3}}) {
    const Axis linear = linear_axis(values, false);
    EXPECT_LT(linear.low, linear.high);
    const Axis log = log_axis(values);
    EXPECT_LT(0, log.low);
    EXPECT_LT(log.low, log.high);
    EXPECT_FALSE(log.ticks().empty());
  }
}

TEST(Bars, LengthsAreProportionalToTheParts) {
  BarPlot plot{"Time", {"first", "second"}, {{"a", {1, 3}}, {"b", {2, 2}}, {"c", {0, 8}}}, false};
  for (const bool share : {false, true}) {
    plot.share = share;
    const std::string svg = draw_bars(plot);
    EXPECT_TRUE(is_well_formed(svg));
    const std::vector<std::string> boxes = elements(svg, "rect");
    ASSERT_EQ(boxes.size(), 1u + 6u + 2u);  // ground, parts, legend
    const double unit = number(boxes[6], "width") / (share ? 100 : 8);
    for (std::size_t bar = 0; bar < 3; ++bar) {
      const double whole = plot.bars[bar].parts[0] + plot.bars[bar].parts[1];
      double at = number(boxes[1], "x");
      for (std::size_t part = 0; part < 2; ++part) {
        const std::string& box = boxes[1 + 2 * bar + part];
        const double length = plot.bars[bar].parts[part] * (share ? 100 / whole : 1) * unit;
        EXPECT_NEAR(number(box, "width"), length, 0.02);
        EXPECT_NEAR(number(box, "x"), at, 0.02);
        EXPECT_EQ(attribute(box, "fill"), attribute(boxes[7 + part], "fill"));  // as the legend says
        at += length;
      }
    }
  }
}

TEST(Plot, ADrawingIsWideEnoughForItsTitle) {
  PanelGrid grid{
      "", {"a"}, {"y"}, "x", AxisScale::kLinear, AxisScale::kLinear, true, true, {"l"}, {{{0, {{1, 1, 1, 1}}}}}};
  const auto width = [&grid] { return number(elements(draw_panels(grid), "svg")[0], "width"); };
  grid.title = "Short";
  const double narrow = width();
  grid.title = "A title that needs more room than a single panel below it has";
  EXPECT_GT(width(), narrow);
  EXPECT_GT(width(), text_width(grid.title, 15));
}

// However many rows the legend takes: no text may end up below the drawing's edge.
TEST(Plot, ADrawingIsHighEnoughForItsLegend) {
  const auto expect_room = [](const std::string& svg) {
    const double height = number(elements(svg, "svg")[0], "height");
    for (const std::string& text : elements(svg, "text")) EXPECT_LT(number(text, "y"), height) << text;
  };
  PanelGrid grid{
      "", {"a"}, {"y"}, "x", AxisScale::kLinear, AxisScale::kLinear, true, true, {}, {{{0, {{1, 1, 1, 1}}}}}};
  BarPlot bars{"", {}, {{"a", {}}}, false};
  for (std::size_t length = 1; length <= 40; ++length) {
    SCOPED_TRACE(length);
    grid.legend.assign(12, std::string(length, 'l'));
    bars.legend = grid.legend;
    bars.bars[0].parts.assign(12, 1);
    expect_room(draw_panels(grid));
    expect_room(draw_bars(bars));
  }
}

}  // namespace
}  // namespace deliso::testing
