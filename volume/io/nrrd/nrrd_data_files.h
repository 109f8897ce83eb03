// The data of an NRRD file that lie in other files: one, a numbered row of files, or a list.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "volume/io/nrrd/nrrd_fields.h"

namespace deliso {

// The paths that `data file` names: `name`, `name%03d.raw FIRST LAST STEP [SUBDIMENSION]`, or `LIST [SUBDIMENSION]` and
// the lines after it. Names are relative to `folder`. Throws InputError when the field is malformed or names more files
// than `most`.
std::vector<std::filesystem::path> nrrd_data_files(const NrrdFields& fields, const NrrdField& field,
                                                   const std::filesystem::path& folder, std::uint64_t most);

}  // namespace deliso
