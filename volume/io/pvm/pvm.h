// Volumes of the V^3 package (.pvm): plain, or packed as a differential data stream (DDS).
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// One byte a voxel, or two, the higher first. Versions PVM, PVM2 and PVM3; the latter two have a spacing. More bytes
// are channels. Throws InputError naming the file and the line of its header.
Volume read_pvm(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
