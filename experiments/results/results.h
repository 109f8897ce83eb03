// The results of an experiment in folders: records in, tables out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runs/experiment.h"
#include "experiments/system/output_names.h"

namespace deliso {

// What write_tables and write_comparison may write into a folder, plots included, by the option that names the folder:
// no input may lie there.
std::vector<NamedFile> result_files(const Experiment& experiment, const std::string& option,
                                    const std::filesystem::path& folder);

// The experiment of which these folders hold records. Throws InputError when a folder has no experiment.json, or
// another experiment's.
Experiment experiment_of(const std::vector<std::filesystem::path>& folders);

// The experiment in `file`, applied to the records of `recorded`. It may have other texts, metrics, plots and published
// figures; throws InputError when it has other runs.
Experiment experiment_for_records(const std::filesystem::path& file, const Experiment& recorded);

// A table as it is printed, and the claims of the answers that its records do not show.
struct PrintedTable {
  std::string markdown;
  std::vector<std::string> untrue;
};

// Merges the records of the folders, writes table.md, table.csv, table.json, table.tex (LaTeX), table.py (matplotlib)
// and the plots (SVG) into `target` and returns the Markdown. Adds remarks about the merging to `notes`. With
// `answers`, the experiment's answers follow the Markdown; the files do not have them. Throws InputError where there
// are none.
PrintedTable write_tables(const Experiment& experiment, const std::vector<std::filesystem::path>& folders,
                          const std::filesystem::path& target, bool answers, std::vector<std::string>& notes);

// Compares the programs that made the records of the folders, writes comparison.md, .csv, .json and .tex into `target`
// and returns the Markdown. Throws InputError like compare_programs (comparison.h).
std::string write_comparison(const Experiment& experiment, const std::vector<std::filesystem::path>& folders,
                             const std::filesystem::path& target, const std::string& by);

}  // namespace deliso
