#include "surface/mesh/io/stl_notes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "surface/base/parameters.h"

namespace deliso {
namespace {

// A word of the header, the line of a mesh file that it stands for, and the option of `verify` that says the same.
// Those that end in = or a blank go on with a value.
struct ShortNote {
  std::string_view word, line, option;

  [[nodiscard]] bool has_value() const { return line.ends_with(' '); }
};

// Short words first: where there is no room for all, few options have to be repeated.
constexpr std::array<ShortNote, 13> kShortNotes = {{{"LPS", "space left-posterior-superior", "--space LPS"},
                                                    {"RAS", "space right-anterior-superior", "--space RAS"},
                                                    {"inv", "field.invert true", "--invert"},
                                                    {"closed", "boundary closed", "--closed"},
                                                    {"local", "local origin", "--local-origin"},
                                                    {"sp=1", "spacing ignore", "--ignore-spacing"},
                                                    {"nan=in", "field.nan inside", "--nan inside"},
                                                    {"nan=out", "field.nan outside", "--nan outside"},
                                                    {"l=", "field.label ", "--label "},
                                                    {"drop=", "components dropped ", "--dropped "},
                                                    {"d=", "promise.max_distance ", "--max-distance "},
                                                    {"s=", "field.smooth ", "--smooth "},
                                                    {"r=", "region ", "--region "}}};
constexpr std::string_view kOurName = "DelIso", kIsovalueInLine = ", isovalue ";

// The value of the note in a line of this kind, empty for those without one.
std::optional<std::string> value_in(const std::string& line, const ShortNote& note) {
  if (!line.starts_with(note.line)) return std::nullopt;
  const std::string rest = line.substr(note.line.size());
  if (note.has_value()) return rest.empty() ? std::nullopt : std::optional(rest);
  const bool is_whole = rest.empty() || rest.front() == ' ' || rest.front() == ',';
  return is_whole ? std::optional(std::string()) : std::nullopt;
}

// What a file that says nothing is taken for.
bool is_default(const std::string& line) {
  return line == "promise.max_distance " + shortest_text(PromiseParameters().max_distance);
}

std::string without_leading_zero(const std::string& value) { return value.starts_with("0.") ? value.substr(1) : value; }

// The line that a word of a header stands for; nothing when it is none of ours.
std::optional<std::string> line_of(std::string_view word) {
  for (const ShortNote& note : kShortNotes) {
    if (!note.has_value()) {
      if (word != note.word) continue;
      return std::string(note.line) + (note.word == "local" ? " of the first sample, to be added to every vertex" : "");
    }
    if (!word.starts_with(note.word)) continue;
    const std::string_view value = word.substr(note.word.size());
    if (value.empty() || value.find_first_not_of("0123456789.,:+-e") != std::string_view::npos) return std::nullopt;
    return std::string(note.line) + (value.front() == '.' ? "0" : "") + std::string(value);
  }
  return std::nullopt;
}

// What only a reader needs: isovalue, local origin, version, and at last the name of the volume.
MeshComments lines_for_readers(const MeshComments& comments) {
  MeshComments lines;
  std::string version;
  for (const std::string& comment : comments) {
    const std::size_t at = comment.find(kIsovalueInLine);
    if (comment.starts_with(kOurName) && at != std::string::npos && at > kOurName.size()) {
      lines.push_back("isovalue " + comment.substr(at + kIsovalueInLine.size()));
      version = "version " + comment.substr(kOurName.size() + 1, at - kOurName.size() - 1);
    }
    if (comment.starts_with("local origin ")) lines.push_back(comment.substr(0, comment.find(',')));
  }
  if (!version.empty()) lines.push_back(version);
  for (const std::string& comment : comments) {
    if (comment.starts_with("volume ")) lines.push_back(comment);
  }
  return lines;
}

}  // namespace

StlNotes short_stl_notes(const MeshComments& comments) {
  StlNotes notes;
  std::string words(kOurName);
  for (const ShortNote& note : kShortNotes) {
    for (const std::string& line : comments) {
      const std::optional<std::string> value = value_in(line, note);
      if (!value || is_default(line)) continue;
      const std::string word = " " + std::string(note.word) + without_leading_zero(*value);
      if (words.size() + word.size() <= kStlHeaderLetters) {
        words += word;
      } else {
        notes.options_needed += (notes.options_needed.empty() ? "" : " ") + std::string(note.option) + *value;
      }
      break;
    }
  }
  notes.comments = lines_for_readers(comments);
  notes.comments.insert(notes.comments.begin(), words);
  return notes;
}

MeshComments long_stl_notes(const MeshComments& comments) {
  if (comments.empty() || !comments.front().starts_with(kOurName)) return comments;
  MeshComments lines = {std::string(kOurName)};
  std::string_view rest = std::string_view(comments.front()).substr(kOurName.size());
  while (!rest.empty()) {
    // Words are all ours or the text is another one, of an earlier version or another program.
    if (rest.front() != ' ') return comments;
    const std::size_t end = std::min(rest.find(' ', 1), rest.size());
    const std::optional<std::string> line = line_of(rest.substr(1, end - 1));
    if (!line) return comments;
    lines.push_back(*line);
    rest.remove_prefix(end);
  }
  lines.insert(lines.end(), comments.begin() + 1, comments.end());
  return lines;
}

}  // namespace deliso
