// The tags of an XML text, one after another: as much of XML as VTK's files use.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "volume/io/base/byte_stream.h"

namespace deliso {

struct XmlTag {
  std::string name;  // with a slash before it when it ends an element
  std::map<std::string, std::string> attributes;
  bool is_closed = false;  // <Name .../>: an element without content
  std::size_t end = 0;     // the place behind it in the text

  // The value of an attribute, or `fallback`.
  [[nodiscard]] std::string value(const std::string& key, const std::string& fallback = "") const {
    const auto place = attributes.find(key);
    return place == attributes.end() ? fallback : place->second;
  }
};

// The next tag from `position` on; comments and declarations are gone over. Nothing at the end of the text. Throws
// InputError when a tag does not end or an attribute has no value.
std::optional<XmlTag> next_xml_tag(const ByteStream& file, std::string_view text, std::size_t position);

}  // namespace deliso
