#include "experiments/results/plot_legend.h"

#include <array>
#include <vector>

namespace deliso {
namespace {

constexpr double kFontSize = 12;
constexpr double kRow = 20;
constexpr double kKeyWidth = 26;
constexpr double kEntryGap = 22;

// Where each entry stands.
std::vector<SvgPoint> places(std::span<const LegendEntry> entries, double width) {
  std::vector<SvgPoint> places;
  SvgPoint at;
  for (const LegendEntry& entry : entries) {
    const double needed = kKeyWidth + 6 + text_width(entry.name, kFontSize);
    if (at.x > 0 && at.x + needed > width) at = {0, at.y + kRow};
    places.push_back(at);
    at.x += needed + kEntryGap;
  }
  return places;
}

}  // namespace

double legend_height(std::span<const LegendEntry> entries, double width) {
  return entries.empty() ? 0 : places(entries, width).back().y + kRow;
}

void draw_legend(std::span<const LegendEntry> entries, SvgPoint corner, double width, SvgDrawing& drawing) {
  const std::vector<SvgPoint> at = places(entries, width);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const SvgPoint place{corner.x + at[i].x, corner.y + at[i].y};
    const std::string_view color = legend_color(i);
    const double middle = place.y + kRow / 2;
    if (entries[i].key == LegendKey::kBox) {
      drawing.rectangle({place.x + kKeyWidth - 14, middle - 6}, 14, 12, color);
    } else {
      if (entries[i].key == LegendKey::kLine) {
        drawing.line({place.x, middle}, {place.x + kKeyWidth, middle}, {color, 1.8});
      }
      draw_mark({place.x + kKeyWidth / 2, middle}, entries[i].key == LegendKey::kMark, color, drawing);
    }
    drawing.text({place.x + kKeyWidth + 6, middle + 4}, entries[i].name, {kFontSize});
  }
}

std::string_view legend_color(std::size_t entry) {
  constexpr std::array<std::string_view, 9> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                       "#56b4e9", "#555555", "#f0e442", "#882255"};
  return kColors[entry % kColors.size()];
}

void draw_mark(SvgPoint at, bool single, std::string_view color, SvgDrawing& drawing) {
  if (!single) {
    drawing.circle(at, 3, color);
    return;
  }
  constexpr double kHalf = 6;
  const std::array<SvgPoint, 4> diamond = {
      SvgPoint{at.x, at.y - kHalf}, {at.x + kHalf, at.y}, {at.x, at.y + kHalf}, {at.x - kHalf, at.y}};
  drawing.polygon(diamond, color);
}

}  // namespace deliso
