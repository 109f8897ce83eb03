#include "experiments/runs/experiment_datasets.h"

#include <cstdlib>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/system/shrinking_input.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/sha256.h"
#include "volume/io/volume_file.h"
#include "volume/isovalue_range.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

void check_file_keys(const StrictObject& object) {
  if (!object.has("isovalue")) object.fail("isovalue", "is required for a file");
  for (const std::string_view key : {"size", "seed"}) {
    if (object.has(key)) object.fail(key, "belongs to a built-in field, but the data set is a file");
  }
  const auto sha256 = object.get<std::string>("sha256", std::string(64, '0'));
  if (sha256.size() != 64 || sha256.find_first_not_of("0123456789abcdef") != std::string::npos) {
    object.fail("sha256", "is not 64 lower-case hexadecimal digits: '" + sha256 + "'");
  }
}

void check_field_keys(const StrictObject& object) {
  for (const std::string_view key : {"also", "sha256", "get"}) {
    if (object.has(key)) object.fail(key, "belongs to a file, but the data set is a built-in field");
  }
  try {
    find_analytic_field(object.get<std::string>("field", ""));
  } catch (const InputError& error) {
    throw InputError(object.place_of("field") + ": " + error.what());
  }
}

Dataset parse_dataset(const Json& value, const std::string& place) {
  const StrictObject object(value, place, kDatasetKeys);
  if (object.has("file") == object.has("field")) {
    throw InputError(place + ": a data set has either the key 'file' or the key 'field'");
  }
  Dataset dataset;
  dataset.name = object.get<std::string>("name", "");
  if (object.has("file")) {
    check_file_keys(object);
    dataset.isovalue = object.get("isovalue", 0.0);
    dataset.file = object.get<std::string>("file", "");
    dataset.also = object.get<std::string>("also", "");
    dataset.sha256 = object.get<std::string>("sha256", "");
    dataset.get = object.get<std::string>("get", "");
    return dataset;
  }
  check_field_keys(object);
  const AnalyticField& field = find_analytic_field(object.get<std::string>("field", ""));
  dataset.field = field.name;
  dataset.isovalue = object.get("isovalue", field.isovalue);
  dataset.size = object.get("size", field.default_size);
  dataset.seed = object.get("seed", std::uint64_t{1});
  return dataset;
}

// The data set of the manifest with this name.
Dataset from_manifest(const std::string& name, const std::vector<Dataset>& manifest, const std::string& place) {
  std::vector<std::string> known;
  known.reserve(manifest.size());
  for (const Dataset& dataset : manifest) known.push_back(dataset.name);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return manifest[static_cast<std::size_t>(found - known.begin())];
  throw InputError(std::string(place).append(": the manifest has no data set '").append(name).append("'") +
                   nearest_name_hint(name, known));
}

std::vector<Dataset> parse_list(const Json& list, const std::string& place, const std::vector<Dataset>& manifest,
                                Mistakes& mistakes) {
  std::vector<Dataset> datasets;
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string here = std::string(place).append("/").append(std::to_string(i));
    mistakes.gather([&] {
      datasets.push_back(list[i].is_string() ? from_manifest(list[i].get<std::string>(), manifest, here)
                                             : parse_dataset(list[i], here));
      if (!names.insert(datasets.back().name).second) {
        throw InputError(here + ": '" + datasets.back().name + "' is the name of two data sets");
      }
    });
  }
  return datasets;
}

std::vector<Dataset> parse_manifest(const StrictObject& object, const fs::path& folder, Mistakes& mistakes) {
  if (!object.has("manifest")) return {};
  const fs::path file = folder / object.get<std::string>("manifest", "");
  const Json document = read_json(file);
  const StrictObject list(document, file.string() + "#", kManifestKeys);
  return parse_list(list.at("datasets"), list.place_of("datasets"), {}, mistakes);
}

}  // namespace

bool parse_datasets(const StrictObject& object, const fs::path& folder, Experiment& experiment, Mistakes& mistakes) {
  Mistakes found;
  std::vector<Dataset> manifest;
  const bool has_manifest = found.gather([&] { manifest = parse_manifest(object, folder, found); });
  const auto parse_key = [&](const char* key) {
    return object.has(key) && has_manifest ? parse_list(object.at(key), object.place_of(key), manifest, found)
                                           : std::vector<Dataset>();
  };
  experiment.datasets = parse_key("datasets");
  experiment.builtin_datasets = parse_key("builtin_datasets");
  found.gather([&] {
    for (const Dataset& dataset : experiment.builtin_datasets) {
      if (dataset.field.empty()) object.fail("builtin_datasets", "holds the file '" + dataset.file + "'");
    }
  });
  const bool knows_all = found.empty() && object.has("datasets");
  mistakes.gather([&found] { found.throw_all(); });
  return knows_all;
}

Json datasets_to_json(const std::vector<Dataset>& datasets) {
  Json list = Json::array();
  for (const Dataset& dataset : datasets) {
    Json& item = list.emplace_back(Json{{"name", dataset.name}, {"isovalue", dataset.isovalue}});
    if (dataset.field.empty()) {
      item["file"] = dataset.file;
      if (!dataset.also.empty()) item["also"] = dataset.also;
      if (!dataset.sha256.empty()) item["sha256"] = dataset.sha256;
      if (!dataset.get.empty()) item["get"] = dataset.get;
    } else {
      item["field"] = dataset.field;
      item["size"] = dataset.size;
      item["seed"] = dataset.seed;
    }
  }
  return list;
}

fs::path default_data_folder(const fs::path& experiment_file) {
  if (const char* folder = std::getenv("DELISO_DATA"); folder != nullptr && *folder != '\0') return folder;
  std::error_code error;
  for (fs::path folder = fs::absolute(experiment_file).parent_path(); folder != folder.root_path();
       folder = folder.parent_path()) {
    if (fs::exists(folder / "CMakeLists.txt", error) && fs::is_directory(folder / "configs", error)) {
      return folder / "data";
    }
  }
  return "data";
}

bool is_present(const Dataset& dataset, const fs::path& data_folder) {
  std::error_code error;
  return !dataset.field.empty() || fs::exists(dataset_path(dataset, data_folder), error);
}

std::string absence_text(const Dataset& dataset, const fs::path& data_folder) {
  const std::string text = dataset.file + " is not in " + data_folder.string() + "; ";
  return text + (dataset.get.empty() ? "put it there, or name its folder with --data" : dataset.get);
}

fs::path dataset_path(const Dataset& dataset, const fs::path& data_folder) {
  if (!dataset.field.empty()) return "field:" + dataset.field;
  std::error_code error;
  const bool other_name = !dataset.also.empty() && !fs::exists(data_folder / dataset.file, error) &&
                          fs::exists(data_folder / dataset.also, error);
  return data_folder / (other_name ? dataset.also : dataset.file);
}

ScalarGrid load_dataset(const Dataset& dataset, const fs::path& data_folder) {
  if (!dataset.field.empty()) return generate_field(dataset.field, dataset.size, dataset.seed);
  const fs::path path = dataset_path(dataset, data_folder);
  end_where_input_shrinks(path);
  ScalarGrid grid = read_volume(path);
  if (!dataset.sha256.empty()) {
    const std::string found = sample_sha256(grid);
    if (found != dataset.sha256) {
      throw InputError(path.string() + ": is not the data set " + dataset.name + ": its samples have the SHA-256 " +
                       found + ", expected " + dataset.sha256);
    }
  }
  if (has_isosurface(grid, dataset.isovalue)) return grid;
  throw InputError(path.string() + ": the isosurface of " + dataset.name + " at " + shortest_text(dataset.isovalue) +
                   " has no point: " + isovalue_range_text(grid, dataset.isovalue));
}

}  // namespace deliso
