// deliso schema: the schema of parameter files and experiments, made from the tables that parse them.
#include <iostream>
#include <memory>

#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/config/config.h"
#include "experiments/runs/experiment_config.h"

namespace deliso {

void add_schema_command(CommandLine& line, ExitCode& exit_code) {
  const auto markdown = std::make_shared<bool>(false);
  Command command = line.add_command("schema", "Print the JSON schema of parameters and experiments");
  command.add_flag("--markdown", *markdown, "Print the parameters as a Markdown table instead");
  command.examples(
      "deliso schema > parameters.schema.json\n"
      "deliso schema --markdown");
  command.callback(exit_code, [markdown] {
    if (*markdown) {
      std::cout << parameters_markdown();
    } else {
      std::cout << json_text(
          Json{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
               {"title", "DelIso"},
               {"$ref", "#/$defs/parameters"},
               {"$defs", Json{{"parameters", parameters_schema()}, {"experiment", experiment_schema()}}}});
    }
    return ExitCode::kDone;
  });
}

}  // namespace deliso
