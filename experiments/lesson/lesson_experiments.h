// The laboratory of configs: the question-first experiments of configs/teaching, run when a page is made. The build
// puts them into the program, so that it needs no file beside it.
#pragma once

#include <atomic>

#include "experiments/config/json.h"

namespace deliso {

// Each experiment with its table, whose records are made here, and its answer: {file, title, question, notes, metrics,
// rows: [{dataset, variant, cells: [{text, numbers}]}], claims: [{figure, is, than}], answer, untrue}. Equal but for
// seconds. `stop` ends a run where it is (null: nothing does); then InputError is thrown.
Json lesson_experiments(const std::atomic<bool>* stop);

}  // namespace deliso
