// The plots of an experiment: what its table and records hold, as SVG.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/results/table.h"
#include "experiments/runs/experiment.h"

namespace deliso {

struct PlotFile {
  std::string name;  // "error.svg"
  std::string svg;
};

// The name of a plot's file.
std::string svg_name(const Plot& plot);

// The plots for which there is a figure at hand, in the experiment's order. `table` and `records` are the experiment's.
std::vector<PlotFile> draw_plots(const Experiment& experiment, const Table& table, const std::vector<Json>& records);

}  // namespace deliso
