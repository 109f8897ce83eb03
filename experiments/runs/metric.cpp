#include "experiments/runs/metric.h"

#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

void collect(const Json& value, const std::string& path, std::vector<std::string>& paths) {
  if (!value.is_object()) {
    paths.push_back(path);
    return;
  }
  for (const auto& [key, held] : value.items()) {
    collect(held, path.empty() ? key : std::string(path).append(1, '.').append(key), paths);
  }
}

std::vector<std::string> paths_of(const Json& record) {
  std::vector<std::string> paths;
  collect(record, "", paths);
  return paths;
}

}  // namespace

Json value_at(const Json& record, const std::string& path) {
  const Json* value = &record;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string key = path.substr(begin, end - begin);
    if (!value->is_object() || !value->contains(key)) return nullptr;
    value = &value->at(key);
    begin = end + 1;
  }
  return *value;
}

const std::vector<std::string>& record_paths(Task task, bool distances) {
  static const std::vector<std::string> kTopology = paths_of(empty_record(Task::kTopology, false));
  static const std::vector<std::string> kMesh = paths_of(empty_record(Task::kMesh, false));
  static const std::vector<std::string> kMeshWithDistances = paths_of(empty_record(Task::kMesh, true));
  if (task == Task::kTopology) return kTopology;
  return distances ? kMeshWithDistances : kMesh;
}

bool is_no_number(const Experiment& experiment, const std::string& path) {
  const Json held = value_at(empty_record(experiment.task, experiment.distances), path);
  return !held.is_null() && !held.is_number();
}

}  // namespace deliso
