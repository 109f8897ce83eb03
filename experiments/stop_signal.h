// SIGINT and SIGTERM as a request to finish early.
#pragma once

#include <atomic>

namespace deliso {

// From now on the first SIGINT or SIGTERM sets the flag that is returned; a second one ends the program at once.
const std::atomic<bool>& catch_stop_signals();

}  // namespace deliso
