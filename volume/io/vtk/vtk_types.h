// The names that VTK's files have for types.
#pragma once

#include <optional>
#include <string_view>

#include "volume/sample_type.h"

namespace deliso {

// Of legacy files ("unsigned_char", "float", "vtktypeint64", ...), in any case.
std::optional<StoredType> legacy_vtk_type(std::string_view name);
// Of XML files ("UInt8", "Float32", ...).
std::optional<StoredType> xml_vtk_type(std::string_view name);

}  // namespace deliso
