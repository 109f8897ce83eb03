// Texts packed with zlib, in base 64, for the page: it holds a longer run so (frame/inflate.js unpacks them).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace deliso {

std::string packed_text(std::string_view text);

std::string base64(std::span<const unsigned char> bytes);

}  // namespace deliso
