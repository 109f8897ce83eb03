#include "surface/mesh/io/comments.h"

#include <algorithm>
#include <string>

#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

constexpr std::size_t kMostComments = 100;

// The next line of a text without its end; `text` goes on behind it.
std::string_view take_row(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view without_blanks(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\0'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

void keep(std::string_view text, MeshComments& comments) {
  text = without_blanks(text);
  if (text.empty() || comments.size() >= kMostComments) return;
  std::string kept(text);
  std::replace_if(
      kept.begin(), kept.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
  comments.push_back(std::move(kept));
}

MeshComments of_ply(std::string_view bytes) {
  MeshComments comments;
  for (std::string_view line = take_row(bytes); !bytes.empty() && line != "end_header"; line = take_row(bytes)) {
    for (const std::string_view keyword : {"comment ", "obj_info "}) {
      if (line.starts_with(keyword)) keep(line.substr(keyword.size()), comments);
    }
  }
  return comments;
}

MeshComments of_hash_lines(std::string_view bytes) {
  MeshComments comments;
  while (!bytes.empty()) {
    const std::string_view line = without_blanks(take_row(bytes));
    if (line.starts_with('#')) keep(line.substr(1), comments);
  }
  return comments;
}

// Ours are joined by "; " in the name of a solid.
MeshComments of_stl(std::string_view bytes) {
  constexpr std::string_view kSolid = "solid ", kOurs = "deliso ";
  const bool is_text = may_be_ascii_stl(bytes) && bytes.substr(0, kSolid.size()).back() == kSolid.back();
  std::string_view line = is_text ? take_row(bytes).substr(kSolid.size()) : bytes.substr(0, kStlHeaderLetters);
  if (is_text && line.starts_with(kOurs)) line.remove_prefix(kOurs.size());
  MeshComments comments;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find("; "), line.size());
    keep(line.substr(0, end), comments);
    line.remove_prefix(std::min(end + 2, line.size()));
  }
  return comments;
}

}  // namespace

MeshComments comments_of(std::string_view bytes, MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return of_ply(bytes);
    case MeshFormat::kOff:
    case MeshFormat::kObj:
    case MeshFormat::kMedit:
      return of_hash_lines(bytes);
    case MeshFormat::kStl:
      return of_stl(bytes);
    default:
      return {};
  }
}

}  // namespace deliso
