#include "experiments/results/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "experiments/runs/metric.h"
#include "experiments/runs/record_file.h"
#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// The finished records of one program, by data set, variant and seed.
using ComparedRuns = std::map<std::array<std::string, 3>, Json>;

struct ComparedProgram {
  std::string name;
  ComparedRuns runs;
};

// In the order in which they are met.
std::vector<ComparedProgram> programs_in(const std::vector<fs::path>& folders, const std::string& by) {
  std::vector<ComparedProgram> programs;
  for (const fs::path& folder : folders) {
    std::vector<std::string> notes;
    for (const fs::path& file : record_files(folder)) {
      for (Json& record : read_records(file, notes)) {
        if (record["status"] != kStatusDone) continue;
        const Json name = value_at(record, "program." + by);
        const std::string text = name.is_string() ? name.get<std::string>() : "unknown";
        const auto is_same = [&text](const ComparedProgram& program) { return program.name == text; };
        auto found = std::find_if(programs.begin(), programs.end(), is_same);
        if (found == programs.end()) found = programs.insert(programs.end(), {text, {}});
        const Json seed = value_at(record, "seed");
        found->runs.try_emplace({record["dataset"].get<std::string>(), record["variant"].get<std::string>(),
                                 seed.is_null() ? record["repeat"].dump() : seed.dump()},
                                std::move(record));
      }
    }
  }
  return programs;
}

// The figure of a metric; null where there is none.
Json compared_figure(const Metric& metric, const Json& record) {
  Json value = value_at(record, metric.value);
  if (!value.is_number() || metric.per.empty()) return value;
  const Json divisor = value_at(record, metric.per);
  if (!divisor.is_number() || divisor.get<double>() == 0) return nullptr;
  return value.get<double>() / divisor.get<double>();
}

// What a row holds of one metric.
struct ComparedCell {
  std::vector<double> logarithms;
  std::size_t unequal = 0;
  std::size_t pairs = 0;
  bool is_text = false;

  void add(const Json& first, const Json& other) {
    if (first.is_null() || other.is_null()) return;
    ++pairs;
    if (first != other) ++unequal;
    if (!first.is_number() || !other.is_number()) {
      is_text = true;
      return;
    }
    const auto a = first.get<double>();
    const auto b = other.get<double>();
    if (a > 0 && b > 0) logarithms.push_back(std::log(b / a));
    if (a == 0 && b == 0) logarithms.push_back(0);
  }
};

Quotients quotients_of(const std::vector<ComparedCell>& cells) {
  std::vector<std::vector<double>> rows;
  rows.reserve(cells.size());
  for (const ComparedCell& cell : cells) rows.push_back(cell.logarithms);
  Quotients quotients = summary_of(rows);
  for (const ComparedCell& cell : cells) {
    quotients.unequal += cell.unequal;
    quotients.is_text = quotients.is_text || cell.is_text;
    if (cell.is_text) quotients.pairs += cell.pairs;
  }
  return quotients;
}

Comparison::Other compare_two(const Experiment& experiment, const ComparedProgram& first,
                              const ComparedProgram& other) {
  Comparison::Other comparison;
  comparison.name = other.name;
  std::map<std::array<std::string, 2>, std::vector<ComparedCell>> rows;
  std::vector<std::array<std::string, 2>> order;
  std::size_t paired = 0;
  for (const auto& [key, record] : first.runs) {
    const auto found = other.runs.find(key);
    if (found == other.runs.end()) continue;
    ++paired;
    const std::array<std::string, 2> name = {key[0], key[1]};
    const auto [row, is_new] = rows.try_emplace(name, experiment.metrics.size());
    if (is_new) order.push_back(name);
    for (std::size_t i = 0; i < experiment.metrics.size(); ++i) {
      row->second[i].add(compared_figure(experiment.metrics[i], record),
                         compared_figure(experiment.metrics[i], found->second));
    }
  }
  comparison.unpaired = first.runs.size() + other.runs.size() - 2 * paired;
  ComparisonRow all;
  for (std::size_t i = 0; i < experiment.metrics.size(); ++i) {
    std::vector<ComparedCell> cells;
    cells.reserve(order.size());
    for (const auto& name : order) cells.push_back(rows.at(name)[i]);
    all.figures.push_back(quotients_of(cells));
  }
  for (const auto& name : order) {
    ComparisonRow& row = comparison.rows.emplace_back(ComparisonRow{name[0], name[1], {}});
    for (const ComparedCell& cell : rows.at(name)) row.figures.push_back(quotients_of({cell}));
  }
  comparison.rows.push_back(std::move(all));
  return comparison;
}

}  // namespace

Quotients summary_of(const std::vector<std::vector<double>>& rows) {
  constexpr int kSamples = 2000;
  constexpr double kTail = 0.025;
  Quotients quotients;
  double sum = 0;
  for (const std::vector<double>& row : rows) {
    quotients.pairs += row.size();
    for (const double logarithm : row) sum += logarithm;
  }
  if (quotients.pairs == 0) return quotients;
  const auto count = static_cast<double>(quotients.pairs);
  quotients.mean = std::exp(sum / count);
  if (quotients.pairs < 2) return quotients;
  Rng rng(1);
  std::vector<double> means;
  means.reserve(kSamples);
  for (int sample = 0; sample < kSamples; ++sample) {
    double drawn = 0;
    for (const std::vector<double>& row : rows) {
      for (std::size_t i = 0; i < row.size(); ++i) drawn += row[rng.below(row.size())];
    }
    means.push_back(drawn / count);
  }
  std::sort(means.begin(), means.end());
  const auto at = [&means](double share) {
    return std::exp(means[static_cast<std::size_t>(std::lround(share * static_cast<double>(means.size() - 1)))]);
  };
  quotients.interval = {at(kTail), at(1 - kTail)};
  return quotients;
}

Comparison compare_programs(const Experiment& experiment, const std::vector<fs::path>& folders, const std::string& by) {
  const std::vector<ComparedProgram> programs = programs_in(folders, by);
  if (programs.size() < 2) {
    throw InputError("--by " + by + ": " +
                     (programs.empty() ? "there are no finished records"
                                       : "all records are of " + by + " '" + programs.front().name + "'") +
                     ", expected those of two at least");
  }
  Comparison comparison{by, programs.front().name, {}};
  for (std::size_t i = 1; i < programs.size(); ++i) {
    comparison.others.push_back(compare_two(experiment, programs.front(), programs[i]));
    if (comparison.others.back().rows.size() == 1) {
      throw InputError("--by " + by + ": '" + programs.front().name + "' and '" + programs[i].name +
                       "' have no run of the same data set, variant and seed");
    }
  }
  return comparison;
}

}  // namespace deliso
