// An experiment: data sets, variants of the parameters, repeats, and the table that answers its question.
//
// Every combination of data set, variant and repeat is one run; runs are numbered data set by data set, repeat by
// repeat, variant by variant, so that the variants take turns. Equal experiments give equal runs, whatever the machine,
// the order or the sharding.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "surface/base/parameters.h"

namespace deliso {

// A volume with an isovalue: a file, or a built-in field.
struct Dataset {
  std::string name;
  double isovalue = 0;
  std::string file;        // looked for in the data folder; empty for a built-in field
  std::string also;        // another name under which the file is taken; may be empty
  std::string sha256;      // of the samples; empty: not checked
  std::string get;         // how a user gets the file, one sentence
  std::string field;       // of volume/fields/analytic_fields.h; empty for a file
  std::int32_t size = 0;   // samples along each axis of the field
  std::uint64_t seed = 1;  // of the field
};

// What makes the mesh of a run: the mesher, or the baseline it is compared with.
enum class Mesher { kDelIso, kMarchingCubes, kCommand };

// Another program that makes the mesh.
struct MesherCommand {
  std::vector<std::string> arguments;  // the program first; with placeholders in braces (command_mesher.h)
  double timeout_seconds = 600;        // it is ended after this time
  std::string mesh_format = "ply";     // the extension of the file that it writes
  std::vector<int> exit_codes = {0};   // with which it has done its work
};

// One setting of the parameters.
struct Variant {
  std::string name;
  Parameters parameters;  // marching cubes uses only `boundary` and `certify`
  Mesher mesher = Mesher::kDelIso;
  MesherCommand command{};  // of kCommand alone
};

// A column of the table.
struct Metric {
  std::string name;
  std::string value;      // where the record holds it: "stages.recover.insertions"
  std::string per;        // divided by this one; empty: not divided
  std::string variant;    // taken from the runs of this variant; empty: from those of the row
  std::string over;       // divided by the median of the runs of this variant; empty: not divided
  std::string reference;  // column of the reference; empty: none
  bool ratio = false;     // ours over the reference's as a column of its own
};

enum class PlotKind { kCurve, kBars, kHistogram };

// A line of a plot: the variants (or data sets) through which it goes. A line with only one is drawn as a mark.
struct PlotSeries {
  std::string name;
  std::vector<std::string> members;
};

// A picture of what the table holds.
struct Plot {
  std::string name;  // of its file, without ".svg"
  std::string title;
  PlotKind kind = PlotKind::kCurve;
  std::vector<std::string> y;  // metrics: of a curve a row of panels each, of bars the parts
  std::string x;               // metric; of a curve
  bool log_x = false;          // of a curve
  bool log_y = false;          // of a curve
  // Lines go through data sets, with a panel for each variant; otherwise lines go through variants.
  bool across_datasets = false;
  std::vector<PlotSeries> series;  // of a curve; of a histogram with one member each
  bool share = false;              // of bars: in per cent of the whole
  std::string value;               // of a histogram: where the record holds the counts
  double bin_width = 1;            // of a histogram, whose first bin begins at 0
  std::string x_label;             // of a histogram
};

// How a figure of the table compares with another, or with a number or a text.
enum class Relation { kEqual, kBelow, kAbove, kAtMost, kAtLeast };

// Something that an answer says and that the records must show.
// Moving nlohmann's JSON is not declared noexcept. NOLINTNEXTLINE(bugprone-exception-escape)
struct Claim {
  std::string figure;  // a reference to a figure: experiments/runs/answer_config.h
  Relation relation = Relation::kEqual;
  Json than;  // a number, a text, or another reference in braces
};

// A paragraph of the answer to the experiment's question. Figures in it are references in braces.
struct Answer {
  std::string text;
  std::vector<Claim> holds;
  // What its figures name and the experiment has not, as after a change of its parameters.
  std::vector<std::string> unknown_variants;
};

// What a run does: mesh the isosurface, or find its exact topology alone.
enum class Task { kMesh, kTopology };

// What a row of the table stands for: a data set with a variant, or a data set with all of them.
enum class RowKind { kRuns, kDatasets };

// Published figures by data set and column. A value is a number or a text.
struct Reference {
  std::string source;
  std::map<std::string, std::map<std::string, Json>> rows;
};

struct Experiment {
  std::string name;
  std::string title;
  std::string question;            // what the table answers; may be empty
  std::vector<std::string> notes;  // what a reader should know, a paragraph each
  std::vector<Answer> answers;     // shown on request only, so that a reader can think first
  Task task = Task::kMesh;
  bool distances = false;  // also measure the distances between mesh and isosurface and self-intersections
  std::vector<Dataset> datasets;
  std::vector<Dataset> builtin_datasets;  // stand in for the others where no file is at hand
  Variant base;                           // what the variants were made from
  std::vector<Variant> variants;          // the sweep is among them; at least one
  std::int32_t repeats = 1;
  std::uint64_t seed = 1;  // of the first repeat; each repeat adds one
  RowKind rows = RowKind::kRuns;
  std::vector<Metric> metrics;
  std::vector<Plot> plots;
  Reference reference;
};

// One run of an experiment, by its position in each list.
struct PlannedRun {
  std::size_t dataset = 0;
  std::size_t variant = 0;
  std::int32_t repeat = 1;  // from 1
};

// All runs, in the order above.
std::vector<PlannedRun> planned_runs(const Experiment& experiment);

// The part `index` (from 1) of `count`.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;
};

// "2/5". Throws InputError.
Shard parse_shard(const std::string& text);

// The runs of a shard: every count-th one, so that each shard gets a share of every data set.
std::vector<PlannedRun> runs_of(const Experiment& experiment, const Shard& shard);

// The seed of a repeat.
inline std::uint64_t seed_of(const Experiment& experiment, std::int32_t repeat) {
  return experiment.seed + static_cast<std::uint64_t>(repeat) - 1;
}

// The same experiment on its built-in fields; unchanged if it has no files. Throws InputError when it has files and
// names no fields to replace them.
Experiment builtin_form(Experiment experiment);

// The same experiment small enough for a test: all its variants once, but for those of other programs, on one tiny
// built-in field.
Experiment smoke_form(Experiment experiment);

}  // namespace deliso
