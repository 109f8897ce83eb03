// Formats that only ITK reads: DICOM (a folder or a file), stacks of TIFF, HDF5, MINC, GIPL, Analyze, ...
//
// CMake builds it in where ITK is found and DELISO_ITK is on. Without it these functions know no format.
#pragma once

#include <filesystem>
#include <string>

#include "volume/io/base/volume.h"

namespace deliso {

// Whether ITK is built in and reads the file, or the folder as a series of DICOM files.
bool reads_by_itk(const std::filesystem::path& path);

// Throws InputError naming the file, with ITK's own words. Precondition: reads_by_itk(path).
Volume read_by_itk(const std::filesystem::path& path, const ChannelChoice& choice);

// The end of a message about a file of an unknown format: ITK's formats by name, and a program that converts the file.
std::string converter_hint(const std::filesystem::path& path);

}  // namespace deliso
