// How mesh files tell of their field.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/world.h"

namespace deliso {
namespace {

constexpr std::string_view kLabelNote = "field.label", kSmoothNote = "field.smooth", kInvertNote = "field.invert",
                           kNanNote = "field.nan", kBoundaryNote = "boundary";

std::string note(std::string_view key, const std::string& value) { return std::string(key) + " " + value; }

}  // namespace

void append_field_notes(const FieldOptions& options, const FieldParameters& parameters, bool is_closed,
                        std::vector<std::string>& lines) {
  if (parameters.smooth) lines.push_back(note(kSmoothNote, shortest_text(*parameters.smooth)));
  if (parameters.invert) lines.push_back(note(kInvertNote, "true"));
  if (options.nan != "refuse") lines.push_back(note(kNanNote, options.nan));
  if (is_closed) lines.push_back(note(kBoundaryNote, "closed"));
}

std::string label_note(const std::vector<std::int32_t>& labels) {
  std::string list;
  for (const std::int32_t label : labels) list += (list.empty() ? "" : ",") + std::to_string(label);
  return note(kLabelNote, list);
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
