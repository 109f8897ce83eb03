// How mesh files tell of their field.
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/commands/field_options.h"
#include "experiments/commands/world.h"
#include "surface/library/mesh_notes.h"

namespace deliso {
namespace {

constexpr std::string_view kNanNote = "field.nan";

}  // namespace

void append_field_notes(const FieldOptions& options, const Parameters& parameters, std::vector<std::string>& lines) {
  for (std::string& line : field_notes(parameters)) lines.push_back(std::move(line));
  if (options.nan != "refuse") lines.push_back(note_line(kNanNote, options.nan));
}

std::string label_note(const std::vector<std::int32_t>& labels) {
  std::string list;
  for (const std::int32_t label : labels) list += (list.empty() ? "" : ",") + std::to_string(label);
  return note_line(kLabelNote, list);
}

void keep_noted_labels(MeshFile& file) {
  if (file.format != MeshFormat::kMedit) return;
  const bool are_noted = note_in(file.comments, kLabelNote).value_or("").find(',') != std::string::npos;
  if (!are_noted) file.mesh.labels.clear();
}

bool take_field_notes(const std::vector<std::string>& comments, FieldOptions& options) {
  const auto value = [&](std::string_view key) { return note_in(comments, key); };
  if (options.label.empty()) options.label = value(kLabelNote).value_or("");
  if (options.smooth.empty()) options.smooth = value(kSmoothNote).value_or("");
  if (value(kInvertNote) == "true") options.invert = true;
  if (options.nan == "refuse") options.nan = value(kNanNote).value_or("refuse");
  return value(kBoundaryNote) == "closed";
}

}  // namespace deliso
