// Legacy VTK files (.vtk) of structured points, as text or binary.
#pragma once

#include <string>

#include "volume/io/base/volume.h"

namespace deliso {

// Reads one array of the point data: the only one, or that of the name `array`. The components of vectors are channels.
// Throws InputError naming the file and the line of its header.
Volume read_legacy_vtk(UnpackedFile& file, const ChannelChoice& choice, const std::string& array);

}  // namespace deliso
