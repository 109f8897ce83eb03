// NIfTI-1 and NIfTI-2: one file (.nii) or a header and its data (.hdr and .img), any of them packed (.gz).
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// World coordinates are those of `sform` where it has a code, else of `qform` (space right-anterior-superior), else the
// spacing alone. Samples are scaled by `scl_slope` and `scl_inter` into doubles, unless these say nothing. Colours and
// complex numbers are several channels. Throws InputError naming the file and the field.
Volume read_nifti(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
