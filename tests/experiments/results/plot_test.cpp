// Plots: do the drawings hold the figures? Places and lengths are read back from the SVG and compared with the table.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/results/plot.h"
#include "experiments/results/svg.h"
#include "tests/support/program_runner.h"
#include "tests/support/run_examples.h"
#include "tests/support/svg_reader.h"

namespace deliso::testing {
namespace {

#define EXPECT_MESSAGE(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

// Two data sets, three variants and repeats; a curve, bars and a histogram.
Experiment example() {
  Json document = small_document();
  document["datasets"] =
      Json::array({Json{{"name", "a<b"}, {"field", "sphere"}, {"size", 8}}, Json{{"name", "c"}, {"field", "torus"}}});
  document["variants"].push_back(Json{{"name", "alone"}});
  document["metrics"] = parse_json(R"([
    {"name": "n", "value": "vertices"}, {"name": "s", "value": "total_seconds"}, {"name": "t", "value": "triangles"},
    {"name": "verdict", "value": "certificate.verdict"}])",
                                   "metrics");
  document["plots"] = parse_json(R"([
    {"name": "curve", "title": "Curve & more", "kind": "curve", "x": "n", "y": ["s", "t"], "log": ["x", "y"],
     "series": [{"name": "line", "members": ["fine", "coarse"]}, {"name": "mark", "members": ["alone"]}]},
    {"name": "across", "title": "Across", "kind": "curve", "x": "n", "y": ["s"], "across": "datasets"},
    {"name": "bars", "title": "Bars", "kind": "bars", "y": ["s", "t"]},
    {"name": "angles", "title": "Angles", "kind": "histogram", "value": "quality.min_angle_histogram", "bin_width": 5,
     "x_label": "angle"}])",
                                 "plots");
  return parse_experiment(document, "small.json");
}

Json record(const std::string& dataset, const std::string& variant, int repeat, double vertices, double seconds,
            const Json& angles) {
  return Json{{"experiment", "small"}, {"dataset", dataset},       {"variant", variant},
              {"repeat", repeat},      {"status", "done"},         {"vertices", vertices},
              {"triangles", 10},       {"total_seconds", seconds}, {"quality", {{"min_angle_histogram", angles}}}};
}

std::vector<Json> example_records() {
  return {record("a<b", "fine", 1, 100, 1, {1, 0, 3}), record("a<b", "fine", 2, 100, 2, {1, 0, 0}),
          record("a<b", "fine", 3, 100, 4, {0, 0, 0}), record("a<b", "coarse", 1, 10, 0.5, {0, 4, 0}),
          record("a<b", "alone", 1, 50, 8, {2, 2, 0})};
}

std::string plot_named(const std::string& name, const std::vector<Json>& records) {
  const Experiment experiment = example();
  for (const PlotFile& file : draw_plots(experiment, make_table(experiment, records), records)) {
    EXPECT_TRUE(is_well_formed(file.svg)) << file.name;
    if (file.name == name) return file.svg;
  }
  return "";
}

TEST(Plot, CurvesGoThroughTheMediansFromLeftToRight) {
  const std::string svg = plot_named("curve.svg", example_records());
  // The data set without records has no panel.
  EXPECT_MESSAGE(svg, ">a&lt;b</text>");
  EXPECT_EQ(svg.find(">c</text>"), std::string::npos);
  const std::vector<std::string> lines = elements(svg, "polyline");
  ASSERT_EQ(lines.size(), 2u);  // one a row
  const std::vector<SvgPoint> line = points_of(lines[0]);
  ASSERT_EQ(line.size(), 2u);
  EXPECT_LT(line[0].x, line[1].x);  // coarse has fewer vertices
  EXPECT_GT(line[0].y, line[1].y);  // and 0.5 s against a median of 2 s
  // The mark's place on logarithmic axes follows from the other two: 50 vertices, 8 s.
  const std::vector<std::string> diamonds = elements(svg, "polygon");
  ASSERT_GE(diamonds.size(), 1u);
  const std::vector<SvgPoint> diamond = points_of(diamonds[0]);
  const double x = (diamond[1].x + diamond[3].x) / 2;
  const double y = (diamond[0].y + diamond[2].y) / 2;
  EXPECT_NEAR((x - line[0].x) / (line[1].x - line[0].x), std::log(50 / 10.) / std::log(100 / 10.), 1e-3);
  EXPECT_NEAR((y - line[0].y) / (line[1].y - line[0].y), std::log(8 / 0.5) / std::log(2 / 0.5), 1e-3);
}

TEST(Plot, SpreadsReachFromTheSmallestToTheLargest) {
  const std::string svg = plot_named("curve.svg", example_records());
  const std::vector<SvgPoint> line = points_of(elements(svg, "polyline")[0]);
  // The spread of "fine" stands at its point, from 1 s to 4 s around the median of 2 s.
  const double octave = (line[0].y - line[1].y) / 2;  // pixels for a factor of 2
  int found = 0;
  for (const std::string& element : elements(svg, "line")) {
    const double x = number(element, "x1");
    if (std::abs(x - line[1].x) > 0.01 || attribute(element, "stroke") != "#0072b2") continue;
    if (x != number(element, "x2")) continue;  // the legend's
    EXPECT_NEAR(number(element, "y1"), line[1].y + octave, 0.02);
    EXPECT_NEAR(number(element, "y2"), line[1].y - octave, 0.02);
    ++found;
  }
  EXPECT_EQ(found, 1);
}

TEST(Plot, HistogramsAddRepeatsAndShowShares) {
  const std::string svg = plot_named("angles.svg", example_records());
  const std::vector<std::string> lines = elements(svg, "polyline");
  ASSERT_EQ(lines.size(), 3u);  // fine, coarse, alone
  const std::vector<SvgPoint> fine = points_of(lines[0]);
  const std::vector<SvgPoint> coarse = points_of(lines[1]);
  ASSERT_EQ(fine.size(), 2u + 2 * 3u);
  const double ground = fine.front().y;
  EXPECT_EQ(fine.back().y, ground);
  const double whole = ground - coarse[3].y;  // all of coarse lies in its second bin
  EXPECT_NEAR(ground - fine[1].y, 0.4 * whole, 0.02);
  EXPECT_NEAR(ground - fine[3].y, 0, 0.02);
  EXPECT_NEAR(ground - fine[5].y, 0.6 * whole, 0.02);
}

// As in the table: a dash, not a bar of length 0.
TEST(Plot, ABarWithoutFiguresIsADash) {
  std::vector<Json> records = example_records();
  for (const char* key : {"total_seconds", "triangles"}) records[4].erase(key);
  const std::string svg = plot_named("bars.svg", records);
  EXPECT_MESSAGE(svg, ">a&lt;b, alone</text>");
  EXPECT_MESSAGE(svg, ">–</text>");
  EXPECT_EQ(svg.find(">0</text>"), svg.rfind(">0</text>"));   // the axis's
  EXPECT_EQ(elements(svg, "rect").size(), 1u + 2 * 2u + 2u);  // ground, parts of fine and coarse, legend
  // A bar of which a part is missing keeps the other.
  records[4]["triangles"] = 7;
  EXPECT_MESSAGE(plot_named("bars.svg", records), ">7</text>");
}

TEST(Plot, PlotsWithoutFiguresAreLeftOut) {
  const Experiment experiment = example();
  EXPECT_TRUE(draw_plots(experiment, make_table(experiment, {}), {}).empty());
  EXPECT_EQ(draw_plots(experiment, make_table(experiment, example_records()), example_records()).size(), 4u);
}

TEST(Plot, RunsAndTablesWriteThemAndShardsGiveTheSame) {
  const TemporaryFolder folder;
  Json document = small_document();
  document["plots"] = parse_json(R"([
    {"name": "size", "title": "Size", "kind": "curve", "x": "vertices", "y": ["share"]},
    {"name": "angles", "title": "Angles", "kind": "histogram", "value": "quality.min_angle_histogram", "bin_width": 5,
     "x_label": "angle"}])",
                                 "plots");
  write_file(folder / "small.json", json_text(document));
  const auto run = [&](const std::string& out, const std::string& shard) {
    const ProgramResult result =
        run_deliso({"run", folder / "small.json", "--out", folder / out, "--shard", shard, "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  run("whole", "1/1");
  run("one", "1/2");
  run("two", "2/2");
  EXPECT_EQ(run_deliso({"table", folder / "one", folder / "two", "-o", folder / "both"}).exit_code, 0);
  for (const std::string name : {"size.svg", "angles.svg"}) {
    const std::string svg = read_file(folder / ("whole/" + name));
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_EQ(read_file(folder / ("both/" + name)), svg) << name;
  }
}

std::string refusal(const std::string& pointer, const Json& value) {
  Json document = experiment_to_json(example());
  if (value.is_null()) {
    const Json::json_pointer place(pointer);
    document[place.parent_pointer()].erase(place.back());
  } else {
    document[Json::json_pointer(pointer)] = value;
  }
  try {
    parse_experiment(document, "small.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Plot, MistakesNameThePlaceAndTheNearestName) {
  EXPECT_EQ(refusal("/plots/0/x", "n"), "");
  EXPECT_EQ(refusal("/plots/0/x", "m"), "small.json#/plots/0/x names no metric: 'm'; the nearest known name is \"n\"");
  EXPECT_MESSAGE(refusal("/plots/0/y/1", "tt"),
                 "small.json#/plots/0/y/1 names no metric: 'tt'; the nearest known name is \"t\"");
  EXPECT_MESSAGE(refusal("/plots/0/y/1", "s"), "#/plots/0/y/1: 's' is there twice");
  EXPECT_MESSAGE(refusal("/plots/0/kind", "curv"), "#/plots/0/kind must be one of 'curve', 'bars', 'histogram'");
  EXPECT_MESSAGE(refusal("/plots/0/log/0", "z"), "#/plots/0/log/0 names no axis: 'z'");
  EXPECT_MESSAGE(refusal("/plots/0/series/0/members/0", "fin"),
                 "names no variant or data set: 'fin'; the nearest known name is");
  EXPECT_MESSAGE(refusal("/plots/0/share", true), "#/plots/0/share does not belong to a plot of the kind curve");
  EXPECT_MESSAGE(refusal("/plots/2/y", nullptr), "#/plots/2/y is required for a plot of the kind bars");
  EXPECT_MESSAGE(refusal("/plots/3/value", "vertices"), "#/plots/3/value names no list of numbers of a record");
  EXPECT_MESSAGE(refusal("/plots/3/bin_width", 0), "#/plots/3/bin_width must be a number from 1e-09");
  EXPECT_MESSAGE(refusal("/metrics/0/value", "certificate.verdict"), "can draw numbers alone: the metric");
  EXPECT_MESSAGE(refusal("/plots/1/name", "curve"), "#/plots/1/name 'curve' is the name of two plots");
  EXPECT_MESSAGE(refusal("/plots/1/name", "../curve"), "#/plots/1/name becomes the name of a file");
}

}  // namespace
}  // namespace deliso::testing
