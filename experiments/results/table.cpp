#include "experiments/results/table.h"

#include <algorithm>
#include <map>

#include "delaunay/base/check.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

// The finished records of each data set and variant.
using RecordsByRun = std::map<std::pair<std::string, std::string>, std::vector<const Json*>>;

// "64 64 64", "homeomorphic", "true".
std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return figure_text(value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : " ") + value_text(item);
  return text;
}

Figure figure_of(const Metric& metric, const std::vector<const Json*>& records) {
  Figure figure;
  std::map<std::string, int> texts;
  for (const Json* record : records) {
    const Json value = value_at(*record, metric.value);
    if (value.is_null()) continue;
    if (!value.is_number()) {
      ++texts[value_text(value)];
      continue;
    }
    double number = value.get<double>();
    if (!metric.per.empty()) {
      const Json divisor = value_at(*record, metric.per);
      if (!divisor.is_number() || divisor.get<double>() == 0) continue;
      number /= divisor.get<double>();
    }
    figure.numbers.push_back(number);
  }
  std::sort(figure.numbers.begin(), figure.numbers.end());
  for (const auto& [text, count] : texts) {
    if (!figure.text.empty()) figure.text += ", ";
    figure.text += texts.size() == 1 ? text : text + " (" + std::to_string(count) + ")";
  }
  return figure;
}

std::vector<const Json*> records_of(const RecordsByRun& done, const std::string& dataset, const std::string& variant) {
  const auto found = done.find({dataset, variant});
  return found == done.end() ? std::vector<const Json*>() : found->second;
}

TableCell cell_of(const Experiment& experiment, const Metric& metric, const RecordsByRun& done,
                  const std::string& dataset, const std::string& row_variant) {
  TableCell cell;
  const std::string& variant = metric.variant.empty() ? row_variant : metric.variant;
  cell.ours = figure_of(metric, records_of(done, dataset, variant));
  if (!metric.over.empty()) {
    const Figure over = figure_of(metric, records_of(done, dataset, metric.over));
    if (over.numbers.empty() || over.median() == 0) cell.ours.numbers.clear();
    for (double& number : cell.ours.numbers) number /= over.median();
  }
  if (metric.reference.empty()) return cell;
  const auto row = experiment.reference.rows.find(dataset);
  if (row == experiment.reference.rows.end() || !row->second.contains(metric.reference)) return cell;
  cell.reference = row->second.at(metric.reference);
  if (cell.reference.is_number() && cell.reference != 0 && !cell.ours.numbers.empty()) {
    cell.ratio = cell.ours.median() / cell.reference.get<double>();
  }
  return cell;
}

// The state of a row's runs: the best of their states.
RowState state_of(const std::vector<const Json*>& records) {
  RowState state = RowState::kNotRun;
  for (const Json* record : records) {
    const auto status = record->at("status").get<std::string>();
    if (status == kStatusDone) return RowState::kDone;
    if (status == kStatusFailed) state = RowState::kFailed;
    if (status == kStatusAbsent && state == RowState::kNotRun) state = RowState::kAbsent;
  }
  return state;
}

class TableMaker {
 public:
  TableMaker(const Experiment& experiment, const std::vector<Json>& records) : experiment_(experiment) {
    for (const Json& record : records) {
      if (const std::string foreign = foreign_part(experiment, record); !foreign.empty()) {
        throw InputError("a record does not belong here: " + foreign);
      }
      const auto dataset = record["dataset"].get<std::string>();
      all_[{dataset, record["variant"].get<std::string>()}].push_back(&record);
      if (record["status"] == kStatusDone) done_[{dataset, record["variant"].get<std::string>()}].push_back(&record);
    }
  }

  Table make() {
    for (const Dataset& dataset : experiment_.datasets) {
      if (experiment_.rows == RowKind::kDatasets) {
        add_row(dataset, "");
      } else {
        for (const Variant& variant : experiment_.variants) add_row(dataset, variant.name);
      }
      add_remarks(dataset);
    }
    for (const auto& [run, records] : done_) {
      for (const Json* record : records) {
        note_program(*record);
        table_.runs_at_a_time = std::max(table_.runs_at_a_time, record->value("runs_at_a_time", std::int64_t{1}));
        if (const Json threads = value_at(*record, "threads"); threads.is_number())
          table_.threads.insert(threads.get<std::int64_t>());
      }
    }
    return std::move(table_);
  }

 private:
  // The records of a row: of one variant, or of all.
  std::vector<const Json*> row_records(const std::string& dataset, const std::string& variant) const {
    if (!variant.empty()) return records_of(all_, dataset, variant);
    std::vector<const Json*> records;
    for (const Variant& one : experiment_.variants) {
      const std::vector<const Json*> more = records_of(all_, dataset, one.name);
      records.insert(records.end(), more.begin(), more.end());
    }
    return records;
  }

  void add_row(const Dataset& dataset, const std::string& variant) {
    TableRow row{dataset.name, variant, state_of(row_records(dataset.name, variant)), {}};
    // If a row is a data set and a metric names no variant, there is only one variant.
    const std::string& own = variant.empty() ? experiment_.variants.front().name : variant;
    for (const Metric& metric : experiment_.metrics) {
      row.cells.push_back(cell_of(experiment_, metric, done_, dataset.name, own));
    }
    table_.rows.push_back(std::move(row));
  }

  void add_remarks(const Dataset& dataset) {
    const std::vector<const Json*> records = row_records(dataset.name, "");
    if (state_of(records) == RowState::kAbsent) {
      table_.remarks.push_back(dataset.name + " is absent (" + dataset.file + ")" +
                               (dataset.get.empty() ? "" : ": " + dataset.get));
      return;
    }
    std::size_t done = 0;
    for (const Json* record : records) {
      if (record->at("status") == kStatusDone) ++done;
      if (record->at("status") == kStatusFailed) {
        table_.remarks.push_back(dataset.name + ", " + record->at("variant").get<std::string>() + ", repeat " +
                                 record->at("repeat").dump() + " failed: " + record->value("error", ""));
      }
    }
    const std::size_t planned = experiment_.variants.size() * static_cast<std::size_t>(experiment_.repeats);
    if (done < planned) {
      table_.remarks.push_back(dataset.name + ": " + std::to_string(done) + " of " + std::to_string(planned) +
                               " runs are finished");
    }
  }

  void note_program(const Json& record) {
    const auto part = [&record](const char* key) {
      const Json value = value_at(record, std::string("program.") + key);
      return value.is_string() ? value.get<std::string>() : std::string("unknown");
    };
    const std::string text = "deliso " + part("version") + ", commit " + part("commit") + ", " + part("compiler") +
                             " (" + part("flags") + "), " + part("cpu");
    if (std::find(table_.programs.begin(), table_.programs.end(), text) == table_.programs.end()) {
      table_.programs.push_back(text);
    }
  }

  const Experiment& experiment_;
  RecordsByRun all_;
  RecordsByRun done_;
  Table table_;
};

}  // namespace

double Figure::median() const {
  const std::size_t n = numbers.size();
  return n % 2 == 1 ? numbers[n / 2] : (numbers[n / 2 - 1] + numbers[n / 2]) / 2;
}

Table make_table(const Experiment& experiment, const std::vector<Json>& records) {
  return TableMaker(experiment, records).make();
}

namespace {

// A time, or a rate: a figure per second.
bool is_time(const Metric& metric) {
  const auto is_of_time = [](const std::string& path) { return path.find("seconds") != std::string::npos; };
  return is_of_time(metric.value) || is_of_time(metric.per);
}

}  // namespace

std::string shared_mark(const Metric& metric, const Table& table) {
  return table.runs_at_a_time > 1 && is_time(metric) ? "*" : "";
}

std::vector<std::string> time_notes(const Experiment& experiment, const Table& table) {
  std::vector<std::string> notes;
  if (std::none_of(experiment.metrics.begin(), experiment.metrics.end(), is_time)) return notes;
  if (table.runs_at_a_time > 1) {
    notes.push_back("* Shared times: up to " + std::to_string(table.runs_at_a_time) +
                    " runs were made at a time on the machine.");
  }
  if (table.threads.size() > 1) {
    std::string numbers;
    for (const std::int64_t count : table.threads) {
      numbers += numbers.empty() ? "" : count == *table.threads.rbegin() ? " and " : ", ";
      numbers += std::to_string(count);
    }
    notes.push_back("Times of runs with different numbers of threads: " + numbers + ".");
  }
  return notes;
}

std::string state_name(RowState state) {
  switch (state) {
    case RowState::kDone:
      return "done";
    case RowState::kFailed:
      return "failed";
    case RowState::kAbsent:
      return "absent";
    case RowState::kNotRun:
      return "not run";
  }
  return "not run";
}

}  // namespace deliso
