// How far a run is, as far as that can be told.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "surface/base/controls.h"

namespace deliso {

// In the order of a run.
inline constexpr std::array<std::string_view, 8> kStageNames = {"index",  "initial", "recover",  "repair",
                                                                "refine", "shape",   "decimate", "certify"};

// Within a stage: vertices done over vertices done plus violations waiting. The number of violations still to come is
// unknown, so it may go back.
inline double share_of_stage(const Progress& progress) {
  const auto done = static_cast<double>(progress.vertices);
  const double all = done + static_cast<double>(progress.queued);
  return progress.queued > 0 && all > 0 ? done / all : 0;
}

// The stages share a run evenly.
inline double share_of_run(const Progress& progress) {
  const auto stage = std::find(kStageNames.begin(), kStageNames.end(), progress.stage) - kStageNames.begin();
  return (static_cast<double>(stage) + share_of_stage(progress)) / static_cast<double>(kStageNames.size());
}

}  // namespace deliso
