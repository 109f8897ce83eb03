// MetaImage: a header as text with its data behind it (.mha) or in another file or files (.mhd).
#pragma once

#include "volume/io/base/volume.h"

namespace deliso {

// World coordinates from `Offset`, `TransformMatrix` and `ElementSpacing`, in the space left-posterior-superior and in
// mm, as the format's programs take them. Data may be compressed (zlib), binary in both byte orders, or text; in the
// same file (LOCAL), in one other, in several (LIST, or a numbered row), of several channels. Throws InputError naming
// the file, the key and the value.
Volume read_metaimage(UnpackedFile& file, const ChannelChoice& choice);

}  // namespace deliso
