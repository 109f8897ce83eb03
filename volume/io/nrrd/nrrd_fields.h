// The lines of an NRRD header as fields, and the values in them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/io/base/byte_stream.h"

namespace deliso {

// One `field: value` line.
struct NrrdField {
  std::string name;  // lower case, in the format's first spelling ("data file", never "datafile")
  std::string value;
  int line = 0;  // counted from 1
};

class NrrdFields {
 public:
  // Reads the magic and all lines up to the blank line that ends the header (or the end of a file of its own).
  explicit NrrdFields(ByteStream& file);

  [[nodiscard]] const NrrdField* find(const std::string& name) const;
  // The field; throws InputError when it is missing.
  [[nodiscard]] const NrrdField& required(const std::string& name) const;
  // Did a blank line end the header? Only then may data follow.
  [[nodiscard]] bool ended_by_blank_line() const { return ended_by_blank_line_; }

  // What follows `data file: LIST`: one file name a line, with the number of the line.
  [[nodiscard]] const std::vector<NrrdField>& list() const { return list_; }
  [[nodiscard]] ByteStream& file() const { return file_; }

  // The values of a field; throws InputError when they do not parse.
  [[nodiscard]] std::int64_t integer(const NrrdField& field, std::string_view text) const;
  [[nodiscard]] double number(const NrrdField& field, std::string_view text) const;
  // Words parted by blanks; `count` of them.
  [[nodiscard]] std::vector<std::string> words(const NrrdField& field, std::size_t count) const;
  // Vectors "(a,b,c)" of three numbers, or "none" (nothing); `count` of them.
  [[nodiscard]] std::vector<std::optional<Vec3>> vectors(const NrrdField& field, std::size_t count) const;

  // Throws InputError: "<path>: line <n>: <sentence>".
  [[noreturn]] void fail(int line, const std::string& sentence) const;
  // Throws InputError: "<path>: line <n>: <field> is "<value>", expected <what>".
  [[noreturn]] void fail_value(const NrrdField& field, const std::string& expected) const;
  [[noreturn]] void fail(const std::string& sentence) const { file_.fail(sentence); }

 private:
  void read_line(const std::string& line, int number);

  ByteStream& file_;
  std::map<std::string, NrrdField> fields_;
  std::vector<NrrdField> list_;
  bool ended_by_blank_line_ = false;
};

// Whether a field `data file` says that a list of files follows.
bool is_file_list(const NrrdField& field);

// ASCII letters made small.
std::string in_small_letters(std::string_view text);

}  // namespace deliso
