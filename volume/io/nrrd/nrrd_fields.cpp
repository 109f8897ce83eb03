#include "volume/io/nrrd/nrrd_fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "delaunay/base/nearest_name.h"

namespace deliso {

namespace {

// All fields of the format; the first name of a row is the one we use, the others mean the same.
constexpr std::array<std::array<std::string_view, 4>, 30> kFieldNames{{
    {"dimension"},
    {"type"},
    {"block size", "blocksize"},
    {"encoding"},
    {"endian"},
    {"content"},
    {"old min", "oldmin"},
    {"old max", "oldmax"},
    {"data file", "datafile"},
    {"line skip", "lineskip"},
    {"byte skip", "byteskip"},
    {"number"},
    {"sample units", "sampleunits"},
    {"sizes"},
    {"spacings"},
    {"thicknesses"},
    {"axis mins", "axismins"},
    {"axis maxs", "axismaxs"},
    {"centers", "centerings"},
    {"labels"},
    {"units"},
    {"kinds"},
    {"space"},
    {"space dimension"},
    {"space units"},
    {"space origin"},
    {"space directions"},
    {"measurement frame"},
    {"min"},
    {"max"},
}};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// The field of this name in our spelling, or nothing.
std::optional<std::string> field_name(std::string_view text) {
  const std::string name = in_small_letters(trimmed(text));
  for (const auto& names : kFieldNames)
    if (!name.empty() && std::find(names.begin(), names.end(), name) != names.end()) return std::string(names[0]);
  return std::nullopt;
}

// Parses the whole text, or nothing.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string in_small_letters(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

bool is_file_list(const NrrdField& field) {
  return field.value == "LIST" || field.value.starts_with("LIST ") || field.value.starts_with("LIST\t");
}

NrrdFields::NrrdFields(ByteStream& file) : file_(file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors put it before a text
  const bool is_empty = file.bound() == 0;
  std::string magic = file.read_line().value_or("");
  if (is_empty) file.fail("the file is empty, expected an NRRD header");
  if (std::string_view(magic).starts_with(kByteOrderMark)) magic.erase(0, kByteOrderMark.size());
  if (magic.rfind("NRRD", 0) != 0)
    fail(1, "the file starts with " + in_quotes(magic) + ", expected NRRD0001 to NRRD0005");
  if (magic.size() != 8 || magic.compare(4, 3, "000") != 0 || magic[7] < '1' || magic[7] > '5')
    fail(1, "the format version is " + in_quotes(magic) + ", expected NRRD0001 to NRRD0005");
  bool is_list = false;
  for (int number = 2;; ++number) {
    const std::optional<std::string> line = file.read_line();
    if (!line) return;
    if (line->empty()) {
      ended_by_blank_line_ = true;
      return;
    }
    if (line->front() == '#') continue;
    if (is_list) {
      list_.push_back({"data file", std::string(trimmed(*line)), number});
      continue;
    }
    read_line(*line, number);
    const NrrdField* data = find("data file");
    is_list = data != nullptr && data->line == number && is_file_list(*data);
  }
}

void NrrdFields::read_line(const std::string& line, int number) {
  // A key/value pair has ":=", a field has ": "; whichever comes first decides.
  const std::size_t colon = line.find(':');
  if (colon != std::string::npos && colon + 1 < line.size() && line[colon + 1] == '=') return;
  if (colon == std::string::npos || (colon + 1 < line.size() && !is_blank(line[colon + 1])))
    fail(number, in_quotes(line) + " is no header line, expected \"field: value\", \"key:=value\" or a # comment");
  const std::string_view written = trimmed(std::string_view(line).substr(0, colon));
  const std::optional<std::string> name = field_name(written);
  if (!name) {
    std::vector<std::string> known;
    known.reserve(kFieldNames.size());
    for (const auto& names : kFieldNames) known.emplace_back(names[0]);
    fail(number, "there is no field " + in_quotes(written) + nearest_name_hint(std::string(written), known));
  }
  NrrdField field{*name, std::string(trimmed(std::string_view(line).substr(colon + 1))), number};
  const auto [place, added] = fields_.emplace(*name, std::move(field));
  if (!added)
    fail(number, "the field \"" + *name + "\" was given in line " + std::to_string(place->second.line) + " already");
}

const NrrdField* NrrdFields::find(const std::string& name) const {
  const auto place = fields_.find(name);
  return place == fields_.end() ? nullptr : &place->second;
}

const NrrdField& NrrdFields::required(const std::string& name) const {
  const NrrdField* field = find(name);
  if (field == nullptr) fail("the header has no field \"" + name + "\"");
  return *field;
}

std::int64_t NrrdFields::integer(const NrrdField& field, std::string_view text) const {
  const auto value = parsed<std::int64_t>(text);
  if (!value) fail(field.line, "\"" + field.name + "\" has " + in_quotes(text) + ", expected a whole number");
  return *value;
}

double NrrdFields::number(const NrrdField& field, std::string_view text) const {
  const auto value = parsed<double>(text);
  if (!value || !std::isfinite(*value))
    fail(field.line, "\"" + field.name + "\" has " + in_quotes(text) + ", expected a finite number");
  return *value;
}

std::vector<std::string> NrrdFields::words(const NrrdField& field, std::size_t count) const {
  std::vector<std::string> out;
  std::string_view rest = trimmed(field.value);
  while (!rest.empty()) {
    const auto end = std::find_if(rest.begin(), rest.end(), is_blank);
    out.emplace_back(rest.begin(), end);
    rest = trimmed(rest.substr(out.back().size()));
  }
  if (out.size() != count) fail_value(field, std::to_string(count) + " values, not " + std::to_string(out.size()));
  return out;
}

std::vector<std::optional<Vec3>> NrrdFields::vectors(const NrrdField& field, std::size_t count) const {
  std::vector<std::optional<Vec3>> out;
  std::string_view rest = trimmed(field.value);
  while (!rest.empty()) {
    if (rest.substr(0, 4) == "none") {
      out.emplace_back(std::nullopt);
      rest = trimmed(rest.substr(4));
      continue;
    }
    const std::size_t close = rest.find(')');
    if (rest.front() != '(' || close == std::string_view::npos) fail_value(field, "vectors like (1,0,0), or none");
    std::string_view inside = rest.substr(1, close - 1);
    std::vector<double> numbers;
    while (true) {
      const std::size_t comma = inside.find(',');
      numbers.push_back(number(field, trimmed(inside.substr(0, comma))));
      if (comma == std::string_view::npos) break;
      inside.remove_prefix(comma + 1);
    }
    if (numbers.size() != 3) fail_value(field, "vectors of three numbers");
    out.emplace_back(Vec3{numbers[0], numbers[1], numbers[2]});
    rest = trimmed(rest.substr(close + 1));
  }
  if (out.size() != count)
    fail_value(field,
               std::to_string(count) + (count == 1 ? " vector, not " : " vectors, not ") + std::to_string(out.size()));
  return out;
}

void NrrdFields::fail(int line, const std::string& sentence) const {
  file_.fail("line " + std::to_string(line) + ": " + sentence);
}

void NrrdFields::fail_value(const NrrdField& field, const std::string& expected) const {
  fail(field.line, "\"" + field.name + "\" is " + in_quotes(field.value) + ", expected " + expected);
}

}  // namespace deliso
