// deliso explain: writes a lesson, a page that shows the algorithm step by step.
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/lesson/lesson_page.h"
#include "experiments/system/files.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"

namespace deliso {
namespace {

struct ExplainCommandOptions {
  std::string output;
  std::string seed = "1";
};

ExitCode run_explain(const ExplainCommandOptions& options) {
  if (options.output.empty()) throw InputError("explain: -o LESSON is required (a page such as lesson.html)");
  LessonOptions lesson;
  lesson.seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  check_writable(options.output, "-o");
  const std::string page = lesson_page(lesson);
  write_text(page, options.output);
  TextTable()
      .row({"lesson", options.output})
      .row({"bytes", std::to_string(page.size())})
      .row({"seed", std::to_string(lesson.seed)})
      .print(std::cout);
  return ExitCode::kDone;
}

}  // namespace

void add_explain_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<ExplainCommandOptions>();
  Command command = line.add_command("explain", "Write a lesson: a page that shows the algorithm step by step");
  command.add_option("-o,--output", options->output, "The page: .html, to be opened from disk").type_name("LESSON");
  command.add_option("--seed", options->seed, "Seed of the random fields and exercises in the page")
      .type_name("N")
      .show_default();
  command.callback(exit_code, [options] { return run_explain(*options); });
}

}  // namespace deliso
