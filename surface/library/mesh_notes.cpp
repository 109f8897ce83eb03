#include "surface/library/mesh_notes.h"

#include <algorithm>
#include <cstdint>

#include "delaunay/base/shortest_text.h"
#include "volume/region.h"

namespace deliso {

std::string note_line(std::string_view key, std::string_view value) {
  return std::string(key) + " " + std::string(value);
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
  return text;
}

std::vector<std::string> kept_notes(const Parameters& parameters, const MeshingResult& result) {
  std::vector<std::string> lines;
  if (!result.stopped_early()) lines.push_back(note_line(kPromiseNote, shortest_text(result.promised_distance)));
  const std::int64_t dropped = result.dropped_components;
  if (dropped > 0) lines.push_back(note_line(kDroppedNote, std::to_string(dropped)));
  const SampleRegion region = region_of(parameters.region);
  if (!region.is_all()) lines.push_back(note_line(kRegionNote, region_text(region)));
  if (parameters.spacing == SpacingUse::kIgnore) lines.push_back(note_line(kSpacingNote, "ignore"));
  return lines;
}

std::vector<std::string> field_notes(const Parameters& parameters) {
  std::vector<std::string> lines;
  const FieldParameters& field = parameters.field;
  if (field.smooth) lines.push_back(note_line(kSmoothNote, shortest_text(*field.smooth)));
  if (field.invert) lines.push_back(note_line(kInvertNote, "true"));
  if (parameters.boundary == Boundary::kClosed) lines.push_back(note_line(kBoundaryNote, "closed"));
  return lines;
}

}  // namespace deliso
