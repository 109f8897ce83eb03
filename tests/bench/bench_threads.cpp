// bench_threads [NAME SIZE | VOLUME ISOVALUE]: what more threads would give than the machine at hand has. Without a
// volume: gyroid_scan, 128^3.
//
// A run asks for 64 threads, but its tasks run one after the other and are timed in processor time. Then they are given
// to 2, 4, 8, 16 and 64 threads in their order, each to the thread that is free first, as run_tasks() does. Tasks
// that have tasks of their own, on as many threads again, end with the longest of them or with their share of all the
// work, whichever is later. What two threads do to each other (memory, caches) is not in the figures, nor are reading
// and writing.
//
// Prints for each stage and for the run: the seconds of one thread, those outside all tasks, those of the longest task,
// and the speed-ups.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/deliso.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"

namespace {

using namespace deliso;

constexpr std::array<int, 6> kThreads = {1, 2, 4, 8, 16, 64};
using Times = std::array<double, kThreads.size()>;  // seconds, by the number of threads

double now() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct StageTimes {
  Times seconds{};
  double serial = 0;   // outside all tasks
  double longest = 0;  // task
};

// When tasks of these durations end that are given in order to the thread that is free first.
double end_of(const std::vector<double>& tasks, std::size_t threads) {
  std::vector<double> free_at(std::max<std::size_t>(std::min(threads, tasks.size()), 1), 0);
  for (const double task : tasks) *std::min_element(free_at.begin(), free_at.end()) += task;
  return *std::max_element(free_at.begin(), free_at.end());
}

// The same for tasks that have tasks of their own. `alone`: how long each takes on one thread.
double end_of_nested(const std::vector<double>& tasks, const std::vector<double>& alone, int threads) {
  const double all = std::accumulate(alone.begin(), alone.end(), 0.0);
  return std::max(*std::max_element(tasks.begin(), tasks.end()), all / threads);
}

class TaskClock {
 public:
  TaskClock() : mark_(now()) {}

  // From here on time counts to this stage.
  void begin_stage(const std::string& stage) {
    if (stage == stage_) return;
    pass();
    if (depth_ > 0) return;
    stage_ = stage;
    if (std::find(order_.begin(), order_.end(), stage) == order_.end()) order_.push_back(stage);
  }

  // Runs tasks one after the other.
  void run(std::size_t count, const std::function<void(std::size_t)>& task) {
    pass();
    const Times before = current_;
    std::array<std::vector<double>, kThreads.size()> of_tasks;
    bool has_nested = false;
    ++depth_;
    for (std::size_t i = 0; i < count; ++i) {
      current_ = {};
      is_nested_ = false;
      task(i);
      has_nested = has_nested || is_nested_;
      pass();
      for (std::size_t n = 0; n < of_tasks.size(); ++n) of_tasks[n].push_back(current_[n]);
      if (depth_ == 1) of_stage().longest = std::max(of_stage().longest, current_.back());
    }
    --depth_;
    is_nested_ = true;
    current_ = before;
    for (std::size_t n = 0; n < of_tasks.size() && count > 0; ++n) {
      current_[n] += has_nested ? end_of_nested(of_tasks[n], of_tasks[0], kThreads[n])
                                : end_of(of_tasks[n], static_cast<std::size_t>(kThreads[n]));
    }
    if (depth_ == 0) settle();
  }

  void print() {
    pass();
    StageTimes all;
    std::cout << std::fixed << std::setprecision(3) << "stage        seconds   serial  longest";
    for (std::size_t n = 1; n < kThreads.size(); ++n) std::cout << std::setw(7) << 'x' << kThreads[n];
    std::cout << '\n';
    for (const std::string& stage : order_) {
      const StageTimes& one = stages_[stage];
      print_row(stage, one);
      for (std::size_t n = 0; n < kThreads.size(); ++n) all.seconds[n] += one.seconds[n];
      all.serial += one.serial;
      all.longest = std::max(all.longest, one.longest);
    }
    print_row("all", all);
    std::cout << "serial share " << std::setprecision(1) << 100 * all.serial / all.seconds[0] << " %\n";
  }

 private:
  StageTimes& of_stage() { return stages_[stage_]; }

  // Adds the time since the last call.
  void pass() {
    const double time = now(), passed = time - mark_;
    mark_ = time;
    for (double& seconds : current_) seconds += passed;
    if (depth_ > 0) return;
    of_stage().serial += passed;
    settle();
  }

  void settle() {
    for (std::size_t n = 0; n < kThreads.size(); ++n) of_stage().seconds[n] += current_[n];
    current_ = {};
  }

  static void print_row(const std::string& name, const StageTimes& times) {
    std::cout << std::left << std::setw(10) << name << std::right << std::setprecision(3) << std::setw(10)
              << times.seconds[0] << std::setw(9) << times.serial << std::setw(9) << times.longest
              << std::setprecision(2);
    for (std::size_t n = 1; n < kThreads.size(); ++n) {
      std::cout << std::setw(8) << times.seconds[0] / std::max(times.seconds[n], 1e-9);
    }
    std::cout << '\n';
  }

  double mark_;
  std::string stage_ = "begin";
  std::vector<std::string> order_ = {"begin"};
  std::map<std::string, StageTimes> stages_;
  int depth_ = 0;           // tasks within tasks
  bool is_nested_ = false;  // whether the task at hand has had tasks of its own
  Times current_{};         // of the task at hand, or since the last settle()
};

void bench(const ScalarGrid& grid, double isovalue) {
  TaskClock clock;
  task_runner() = [&](std::size_t count, const std::function<void(std::size_t)>& task) { clock.run(count, task); };
  MeshingOptions options;
  options.threads = kThreads.back();
  options.progress = [&](const Progress& progress) { clock.begin_stage(std::string(progress.stage)); };
  const MeshingResult result = mesh_isosurface(grid, isovalue, options);
  task_runner() = nullptr;
  clock.print();
  std::cout << result.mesh.points.size() << " vertices, " << (is_proven(result.certificate) ? "" : "not ")
            << "proven\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 1 && argc != 3) {
    std::cerr << "usage: bench_threads [NAME SIZE | VOLUME ISOVALUE]\n";
    return 2;
  }
  try {
    const std::string name = argc == 1 ? "gyroid_scan" : argv[1];
    const auto& fields = analytic_fields();
    const bool is_built_in =
        std::any_of(fields.begin(), fields.end(), [&](const AnalyticField& field) { return field.name == name; });
    if (is_built_in) {
      bench(generate_field(name, argc == 1 ? 128 : std::atoi(argv[2])), find_analytic_field(name).isovalue);
    } else {
      bench(read_volume(name), std::atof(argv[2]));
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
