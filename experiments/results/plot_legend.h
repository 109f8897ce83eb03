// The legend below a plot: coloured keys with their names, in as many rows as they need.
#pragma once

#include <span>
#include <string>

#include "experiments/results/svg.h"

namespace deliso {

enum class LegendKey { kLine, kMark, kBox };

struct LegendEntry {
  std::string name;
  LegendKey key = LegendKey::kLine;
};

// The height of the legend over a width, in pixels.
double legend_height(std::span<const LegendEntry> entries, double width);

// Draws it with its upper left corner at `corner`.
void draw_legend(std::span<const LegendEntry> entries, SvgPoint corner, double width, SvgDrawing& drawing);

// The colour of an entry: colours that the colour-blind tell apart (Okabe and Ito 2008).
std::string_view legend_color(std::size_t entry);

// The mark of a line's point, and the one of a line that is a single point.
void draw_mark(SvgPoint at, bool single, std::string_view color, SvgDrawing& drawing);

}  // namespace deliso
