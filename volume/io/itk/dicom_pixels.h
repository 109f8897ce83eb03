// Whether a DICOM file holds all the bytes of its pixels. GDCM fills up what is missing and says nothing, so a slice that
// a copy cut off would be a wall in the volume.
#pragma once

#ifdef DELISO_HAS_ITK

#include <filesystem>

namespace deliso {

// DICOM part 5: the length of Pixel Data in sections 7.1 and 8.1, compressed pixels in annex A.4. True for files without
// pixels and for those that are compressed as a whole, of which it can not be told.
bool holds_all_pixels(const std::filesystem::path& path);

}  // namespace deliso

#endif
