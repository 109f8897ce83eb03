// The transcript of a run: a sentence for each event of its trace, for a terminal, a screen reader or a diff.
#pragma once

#include <string>

#include "experiments/lesson/trace/trace_writer.h"

namespace deliso {

// One line without its end. Vertices are called by their numbers, lengths are in smallest spacings.
std::string sentence_of(const TraceEvent& event);

}  // namespace deliso
