// The answers of an experiment: their figures put in from the table, their claims compared with it.
#pragma once

#include <string>
#include <vector>

#include "experiments/results/table.h"
#include "experiments/runs/experiment.h"

namespace deliso {

struct AnswerText {
  std::string markdown;             // to be printed below the table
  std::vector<std::string> untrue;  // a sentence for each claim that the records do not show
};

// Precondition: the table is that of the experiment. Throws InputError where the experiment has no answers.
AnswerText answer_text(const Experiment& experiment, const Table& table);

}  // namespace deliso
