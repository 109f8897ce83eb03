// deliso explain: writes a lesson, a page that shows the algorithm step by step; or the trace of a run, or its
// transcript.
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/stated_options.h"
#include "experiments/config/config.h"
#include "experiments/lesson/lesson_experiments.h"
#include "experiments/lesson/lesson_figure.h"
#include "experiments/lesson/lesson_page.h"
#include "experiments/lesson/lesson_run.h"
#include "experiments/lesson/trace/transcript.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/stop_signal.h"
#include "experiments/system/text_table.h"
#include "surface/library/run_report.h"
#include "volume/fields/field_slices.h"
#include "volume/io/base/input_file.h"

namespace deliso {
namespace {

struct ExplainCommandOptions {
  std::string volume;
  std::string isovalue;
  std::string output;
  std::string trace;
  std::string figure;
  std::string config;
  std::vector<std::string> assignments;
  std::string seed = "1";
  std::string threads = "1";
  bool text = false;
  bool answers = false;
  bool without_experiments = false;
};

MeshingOptions meshing_options(const ExplainCommandOptions& options) {
  MeshingOptions meshing;
  if (!options.config.empty()) meshing.parameters = read_parameters(options.config);
  for (const std::string& assignment : options.assignments) set_parameter(assignment, meshing.parameters);
  check_agreement({options.assignments, {}, {}}, nullptr, meshing.parameters);
  meshing.seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  meshing.threads = parse_threads(options.threads);
  meshing.stop = &catch_stop_signals();
  return meshing;
}

// The runs of the page: that of the volume, or of the built-in torus; and noise, which shows every refusal.
std::vector<LessonRun> observed_runs(const ExplainCommandOptions& options, const MeshingOptions& meshing) {
  constexpr std::int32_t kTorusSize = 16, kNoiseSize = 8;
  constexpr double kTorusIsovalue = 0.7, kNoiseIsovalue = 127.5;
  std::vector<LessonRun> runs;
  if (options.volume.empty()) {
    runs.push_back(run_observed("torus", generate_field("torus", kTorusSize), kTorusIsovalue, meshing));
  } else {
    FieldOptions field;
    field.isovalue = options.isovalue;
    check_field_options(field);
    VolumeOptions volume;
    volume.path = options.volume;
    const Volume loaded = load_volume(volume);
    check_apart_from_data(loaded.data_files, {{"-o", options.output}, {"--trace", options.trace}});
    const ChosenField chosen =
        choose_field(options.volume, loaded, field, meshing.parameters.field, region_of(meshing.parameters.region));
    runs.push_back(
        run_observed(std::filesystem::path(options.volume).filename().string(), chosen.grid, chosen.isovalue, meshing));
  }
  if (!options.output.empty())
    runs.push_back(run_observed("noise", generate_field("noise", kNoiseSize), kNoiseIsovalue, meshing));
  return runs;
}

std::string trace_text(const LessonRun& run) {
  std::string text = json_line({{"e", "begin"},
                                {"schema", "deliso-trace-1"},
                                {"program", program_json()},
                                {"volume", run.name},
                                {"isovalue", run.result.isovalue_used}}) +
                     "\n";
  for (const Json& event : run.events) text += json_line(event) + "\n";
  return text;
}

// A name says what is in a file: a page is HTML, a figure SVG. A name without an extension says nothing.
void check_extension(const ExplainCommandOptions& options) {
  const std::string found = lower_case_extension(options.output);
  const std::string expected = options.figure.empty() ? ".html" : ".svg";
  if (found.empty() || found == expected || (options.figure.empty() && found == ".htm")) return;
  throw InputError("-o " + options.output + ": the " + (options.figure.empty() ? "lesson" : "figure") +
                   " is written as " + expected.substr(1) + ", expected a name that ends in " + expected);
}

// Finds everything that could prevent the results from being written before the work starts.
void check_outputs(const ExplainCommandOptions& options) {
  check_extension(options);
  if (!options.output.empty()) check_writable(options.output, "-o");
  if (!options.trace.empty()) check_writable(options.trace, "--trace");
  check_distinct({{"VOLUME", options.volume}, {"--config", options.config}},
                 {{"-o", options.output}, {"--trace", options.trace}});
  check_one_standard_output({{"--text", options.text ? "-" : ""}, {"-o", options.output}, {"--trace", options.trace}});
}

// A line for each run that did not reach its end, whose steps are shown all the same.
ExitCode tell_what_stopped(const std::vector<LessonRun>& runs, const MeshingOptions& meshing) {
  ExitCode exit_code = ExitCode::kDone;
  for (const LessonRun& run : runs) {
    if (!run.result.stopped_early()) continue;
    std::cerr << "deliso: " << run.name << ": " << unmet_goals(meshing, run.result).front() << '\n';
    exit_code = ExitCode::kStopped;
  }
  return exit_code;
}

ExitCode run_explain(const ExplainCommandOptions& options) {
  if (options.output.empty() && options.trace.empty() && !options.text)
    throw InputError("explain: -o LESSON (a page such as lesson.html), --trace or --text is required");
  if (!options.figure.empty() && options.output.empty())
    throw InputError("explain: --figure needs -o FIGURE (a picture such as step.svg)");
  if (!options.volume.empty() && options.isovalue.empty())
    throw InputError("explain: --isovalue is required with a volume");
  if (options.volume.empty() && !options.isovalue.empty())
    throw InputError("explain: --isovalue needs a volume; without one the built-in torus is shown");
  check_outputs(options);
  LessonOptions lesson;
  lesson.seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  lesson.shows_answers = options.answers;

  const MeshingOptions meshing = meshing_options(options);
  const std::vector<LessonRun> runs = observed_runs(options, meshing);
  const ExitCode exit_code = tell_what_stopped(runs, meshing);
  if (!options.trace.empty()) write_text(trace_text(runs.front()), options.trace);
  if (options.text) {
    for (const Json& event : runs.front().events) std::cout << sentence_of(event) << '\n';
  }
  if (options.output.empty()) return exit_code;
  lesson.runs = &runs;
  Json experiments;
  if (options.figure.empty() && !options.without_experiments) {
    experiments = lesson_experiments(&catch_stop_signals());
    lesson.experiments = &experiments;
  }
  const std::string page = options.figure.empty() ? lesson_page(lesson) : lesson_figure(lesson, options.figure);
  write_text(page, options.output);
  if (options.text) return exit_code;
  // Where a result goes to standard output, nothing else does.
  const bool is_taken = is_standard_stream(options.output) || is_standard_stream(options.trace);
  TextTable()
      .row({options.figure.empty() ? "lesson" : "figure", options.output})
      .row({"bytes", std::to_string(page.size())})
      .row({"events", std::to_string(runs.front().events.size())})
      .row({"seed", std::to_string(lesson.seed)})
      .print(is_taken ? std::cerr : std::cout);
  return exit_code;
}

}  // namespace

void add_explain_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<ExplainCommandOptions>();
  Command command = line.add_command("explain", "Write a lesson: a page that shows the algorithm step by step");
  command.add_option("VOLUME", options->volume, "A small volume to mesh step by step (default: the built-in torus)")
      .type_name("")
      .check(refuse_empty_name);
  command.add_option("--isovalue", options->isovalue, "The value whose isosurface is meshed")
      .type_name("K")
      .check(refuse_empty_value);
  command.add_option("-o,--output", options->output, "The page: .html, to be opened from disk")
      .type_name("LESSON")
      .check(refuse_empty_name);
  command.add_option("--figure", options->figure, "One picture of the page as SVG, such as recover/3 (needs Chromium)")
      .type_name("CHAPTER/STEP")
      .check(refuse_empty_value);
  command.add_option("--trace", options->trace, "Write every step of the run as JSON lines")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_flag("--text", options->text, "Say every step of the run in a sentence, on stdout");
  command.add_flag("--answers", options->answers, "The page shows the answers of its exercises at once");
  command.add_flag("--without-experiments", options->without_experiments,
                   "Leave chapter 11 out, whose experiments take some seconds");
  command.add_option("--config", options->config, "Parameters in a JSON file")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_option("--set", options->assignments, "One parameter, key.path=value (repeatable; after --config)")
      .type_name("KEY=VALUE")
      .repeatable();
  command.add_option("--seed", options->seed, "Seed of the run, and of the random fields and exercises in the page")
      .type_name("N")
      .show_default();
  command.add_option("--threads", options->threads, "Threads to use, or auto; the lesson is the same for any number")
      .type_name("N")
      .show_default();
  command.examples(
      "deliso explain -o lesson.html\n"
      "deliso explain small.nrrd --isovalue 50 --text");
  command.callback(exit_code, [options] { return run_explain(*options); });
}

}  // namespace deliso
