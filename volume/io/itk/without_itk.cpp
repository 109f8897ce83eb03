// The reader when ITK is not built in.
#include "delaunay/base/check.h"
#include "volume/io/itk/itk_reader.h"

#ifndef DELISO_HAS_ITK

namespace deliso {

bool reads_by_itk(const std::filesystem::path& /*path*/) { return false; }

Volume read_by_itk(const std::filesystem::path& path, const ChannelChoice& /*choice*/) {
  throw InputError(path.string() + ": the program is built without ITK");
}

}  // namespace deliso

#endif
