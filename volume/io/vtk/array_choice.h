// Which of several named arrays to read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "volume/io/base/byte_stream.h"

namespace deliso {

// The place of `wanted` among the names; of the only one when nothing is wanted. Throws InputError with a sentence that
// names the choices.
inline std::size_t choose_array(const ByteStream& file, const std::vector<std::string>& names,
                                const std::string& wanted) {
  if (names.empty()) file.fail("the file has no array of point data, expected one");
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (names[n] == wanted) return n;
  }
  if (!wanted.empty()) file.fail("there is no array " + in_quotes(wanted) + " of point data: the file has " + list);
  if (names.size() > 1)
    file.fail("the file has several arrays of point data: choose one with its name (--array), of " + list);
  return 0;
}

}  // namespace deliso
