#include <algorithm>
#include <array>
#include <string_view>

#include "volume/io/base/input_file.h"
#include "volume/io/itk/itk_reader.h"

namespace deliso {

namespace {

#ifdef DELISO_HAS_ITK
constexpr std::string_view kDicomHint =
    "; ITK, which is built in, finds no DICOM there: dcm2niix may convert it to NIfTI";
constexpr std::string_view kOtherHint = "; ITK, which is built in, does not read it: 3D Slicer may convert it to NRRD";
#else
constexpr std::string_view kDicomHint =
    "; DICOM is read where the program is built with ITK (DELISO_ITK), or convert it to NIfTI with dcm2niix";
constexpr std::string_view kOtherHint =
    "; files of this kind are read where the program is built with ITK (DELISO_ITK), or convert them to NRRD with 3D "
    "Slicer";
#endif

}  // namespace

std::string converter_hint(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (std::filesystem::is_directory(path) || extension == ".dcm" || extension == ".ima" || extension == ".dicom")
    return std::string(kDicomHint);
  constexpr std::array<std::string_view, 10> kOthers{".tif",  ".tiff", ".h5",  ".hdf5", ".mnc",
                                                     ".gipl", ".lsm",  ".img", ".bmp",  ".png"};
  if (std::find(kOthers.begin(), kOthers.end(), extension) == kOthers.end()) return "";
  return std::string(kOtherHint);
}

}  // namespace deliso
