// The files beside a table: LaTeX for a paper, and a script that draws it.
#pragma once

#include <string>

#include "experiments/results/table.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// A `tabular` with the rules of the package booktabs, to be put into a document with \input. It is the table that
// Markdown shows, with medians and their spread.
std::string table_latex(const Experiment& experiment, const Table& table);

// A text with the characters that LaTeX takes for commands escaped.
std::string latex_text(const std::string& text);

// A script for Python with matplotlib that reads table.json (and for histograms the records) beside it and draws the
// experiment's plots, or where there are none a panel for each metric. To be changed by whoever needs another look.
std::string table_script(const Experiment& experiment);

}  // namespace deliso
