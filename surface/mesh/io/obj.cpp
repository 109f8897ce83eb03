// OBJ (Wavefront): `v` and `f` lines. Every other statement of the format (normals, textures, groups, materials, free
// forms) is skipped. A line that is no OBJ statement is an error, so that another kind of file does not pass for an
// empty mesh.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

constexpr std::array<std::string_view, 43> kSkippedStatements = {
    "vt",     "vn",     "vp",    "p",    "l",        "g",        "s",      "o",   "mg",   "usemtl",     "mtllib",
    "usemap", "maplib", "bevel", "lod",  "c_interp", "d_interp", "cstype", "deg", "bmat", "step",       "curv",
    "curv2",  "surf",   "parm",  "trim", "hole",     "scrv",     "sp",     "end", "con",  "shadow_obj", "trace_obj",
    "ctech",  "stech",  "call",  "csh",  "bsp",      "bzp",      "cdc",    "cdp", "res",  "fo"};

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors put it before a text

bool is_skipped(std::string_view keyword) {
  return std::find(kSkippedStatements.begin(), kSkippedStatements.end(), keyword) != kSkippedStatements.end();
}

// Reads the lines of one file. Indices may name points that come later, so the largest is checked at the end.
class ObjParser {
 public:
  ObjParser(std::string_view bytes, const std::string& file) : in_(bytes, file, '#'), file_(file) {}

  TriangleMesh parse() {
    do {
      const std::string_view keyword = in_.word_on_line();
      if (keyword == "v") {
        parse_point();
      } else if (keyword == "f") {
        parse_polygon();
      } else if (!keyword.empty()) {
        if (!is_skipped(keyword)) in_.fail("a statement of the OBJ format (v, f, vn, g, usemtl, ...)", keyword);
        skip_statement();
      }
    } while (in_.next_line());
    if (largest_ >= static_cast<std::int64_t>(mesh_.points.size())) {
      throw InputError(file_ + ", line " + std::to_string(largest_line_) + ": expected an index of at most " +
                       std::to_string(mesh_.points.size()) + ", found " + std::to_string(largest_ + 1));
    }
    return std::move(mesh_);
  }

 private:
  // A line that ends in a backslash goes on in the next one.
  void skip_statement() {
    std::string_view last;
    do {
      last = {};
      for (std::string_view word = in_.word_on_line(); !word.empty(); word = in_.word_on_line()) last = word;
    } while (last.ends_with('\\') && in_.next_line());
  }

  void parse_point() {
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view found = in_.word_on_line();
      if (!parse_number(found, p[axis]) || !std::isfinite(p[axis])) in_.fail("a finite coordinate", found);
    }
    // A weight or colours may follow, or the line goes on.
    for (std::string_view word = in_.word_on_line(); !word.empty(); word = in_.word_on_line()) {
      double number = 0;
      if (word == "\\") {
        in_.next_line();
      } else if (!parse_number(word, number)) {
        in_.fail("a number or the end of the line after the coordinates", word);
      }
    }
    if (mesh_.points.size() + 1 >= std::numeric_limits<std::uint32_t>::max())
      in_.fail("fewer than 2^32 - 1 points", "");
    mesh_.points.push_back(p);
  }

  // Corners are i, i/t, i/t/n or i//n; negative ones count back from the latest point.
  void parse_polygon() {
    polygon_.clear();
    while (true) {
      const std::string_view found = in_.word_on_line();
      if (found == "\\") {  // the line goes on
        in_.next_line();
        continue;
      }
      if (found.empty()) break;
      std::int64_t i = 0;
      const bool is_of_integers = found.find_first_not_of("0123456789-+/") == std::string_view::npos;
      if (!is_of_integers || !parse_integer(found.substr(0, found.find('/')), i) || i == 0) {
        in_.fail("the index of a point", found);
      }
      i = i > 0 ? i - 1 : i + static_cast<std::int64_t>(mesh_.points.size());
      if (i < 0 || i >= std::numeric_limits<std::uint32_t>::max()) in_.fail("the index of a point", found);
      if (i > largest_) {
        largest_ = i;
        largest_line_ = in_.line();
      }
      polygon_.push_back(static_cast<std::uint32_t>(i));
    }
    if (polygon_.size() < 3) in_.fail("a polygon with at least 3 corners", std::to_string(polygon_.size()));
    append_fan(mesh_, polygon_);
  }

  TextScanner in_;
  std::string file_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> polygon_;
  std::int64_t largest_ = -1;
  std::int64_t largest_line_ = 0;
};

}  // namespace

std::string obj_bytes(const TriangleMesh& mesh, const MeshComments& comments) {
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  text.reserve(64 * mesh.points.size() + 24 * mesh.triangles.size());
  for (const Vec3& p : mesh.points) {
    text += "v ";
    append_point(text, p);
  }
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const std::uint32_t v : triangle) {
      text += ' ';
      append_number(text, std::uint64_t{v} + 1);
    }
    text += '\n';
  }
  return text;
}

bool begins_as_obj(std::string_view head) {
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  TextScanner in(head, "", '#');
  do {
    std::string_view word = in.word_on_line();
    if (word.empty()) continue;  // blank, or a comment
    if (word == "v") {
      double number = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (!parse_number(in.word_on_line(), number)) return false;
      }
      return true;
    }
    if (!is_skipped(word)) return false;
    while (!word.empty()) word = in.word_on_line();
  } while (in.next_line());
  return false;
}

TriangleMesh parse_obj(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  return ObjParser(bytes, file).parse();
}

}  // namespace deliso
