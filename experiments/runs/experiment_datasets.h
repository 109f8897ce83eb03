// The data sets of an experiment: from JSON, and from a data folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/mistakes.h"
#include "experiments/config/strict_object.h"
#include "experiments/runs/experiment.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Reads `datasets` and `builtin_datasets`, with the help of `manifest` (a file relative to `folder`). Returns whether
// the names of all are known, that is, whether there was no mistake.
bool parse_datasets(const StrictObject& object, const std::filesystem::path& folder, Experiment& experiment,
                    Mistakes& mistakes);

Json datasets_to_json(const std::vector<Dataset>& datasets);

// The default data folder: $DELISO_DATA, else data/ in the checkout that holds the experiment's file, else data/ here.
std::filesystem::path default_data_folder(const std::filesystem::path& experiment_file);

// Whether the data set is a built-in field or its file lies in the folder.
bool is_present(const Dataset& dataset, const std::filesystem::path& data_folder);

// "leg.nrrd is not in DIR; get it from ...".
std::string absence_text(const Dataset& dataset, const std::filesystem::path& data_folder);

// The file, or its substitute in a record ("field:sphere").
std::filesystem::path dataset_path(const Dataset& dataset, const std::filesystem::path& data_folder);

// Precondition: is_present. Throws InputError when the file is invalid, the hash of its samples differs from the
// experiment's, or the isosurface has no point.
ScalarGrid load_dataset(const Dataset& dataset, const std::filesystem::path& data_folder);

}  // namespace deliso
