// Arrays of NumPy (.npy, versions 1 to 3).
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// Sample (i, j, k) is element [k, j, i] of the array, whether it is stored in C or in Fortran order. Of four axes the
// last counts channels when it is shorter than the first, else the first counts volumes. Throws InputError naming the
// file and the entry of its header.
Volume read_npy(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
