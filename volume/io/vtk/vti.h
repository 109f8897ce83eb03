// VTK's XML files of image data (.vti).
#pragma once

#include <string>

#include "volume/io/base/volume.h"

namespace deliso {

// Reads one array of the point data: the only one, or that of the name `array`; as text, binary (base64) or appended
// (raw or base64), packed by zlib or not. The components of vectors are channels. World coordinates from Origin,
// Spacing and Direction. Throws InputError naming the file and the attribute.
Volume read_vti(UnpackedFile& file, const ChannelChoice& choice, const std::string& array);

}  // namespace deliso
