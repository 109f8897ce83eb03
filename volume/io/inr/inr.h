// INRIMAGE-4 (.inr): a header as text, its data behind it.
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// Spacing from VX, VY, VZ, the point of the first sample from TX, TY, TZ; VDIM values of each place are channels; fixed
// numbers are scaled by SCALE. Throws InputError naming the file, the key and the value.
Volume read_inr(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
