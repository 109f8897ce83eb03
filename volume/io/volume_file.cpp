#include "volume/io/volume_file.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "delaunay/base/check.h"
#include "volume/io/inr/inr.h"
#include "volume/io/itk/itk_reader.h"
#include "volume/io/metaimage/metaimage.h"
#include "volume/io/mrc/mrc.h"
#include "volume/io/nifti/nifti.h"
#include "volume/io/nrrd/nrrd.h"
#include "volume/io/numpy/npy.h"
#include "volume/io/pvm/pvm.h"
#include "volume/io/raw/raw.h"
#include "volume/io/vtk/legacy_vtk.h"
#include "volume/io/vtk/vti.h"

namespace deliso {

namespace {

enum class VolumeFormat { kNrrd, kNifti, kMetaImage, kLegacyVtk, kVti, kNpy, kMrc, kInr, kPvm, kRaw };

std::optional<VolumeFormat> format_of_extension(const std::string& extension) {
  static constexpr std::array<std::pair<std::string_view, VolumeFormat>, 16> kFormats{
      {{".nrrd", VolumeFormat::kNrrd},
       {".nhdr", VolumeFormat::kNrrd},
       {".nii", VolumeFormat::kNifti},
       {".hdr", VolumeFormat::kNifti},
       {".mhd", VolumeFormat::kMetaImage},
       {".mha", VolumeFormat::kMetaImage},
       {".vtk", VolumeFormat::kLegacyVtk},
       {".vti", VolumeFormat::kVti},
       {".npy", VolumeFormat::kNpy},
       {".mrc", VolumeFormat::kMrc},
       {".map", VolumeFormat::kMrc},
       {".ccp4", VolumeFormat::kMrc},
       {".rec", VolumeFormat::kMrc},
       {".inr", VolumeFormat::kInr},
       {".pvm", VolumeFormat::kPvm},
       {".raw", VolumeFormat::kRaw}}};
  for (const auto& [known, format] : kFormats) {
    if (extension == known) return format;
  }
  return std::nullopt;
}

// By the first bytes of the file, uncompressed.
std::optional<VolumeFormat> format_of_content(UnpackedFile& file) {
  std::string start(512, '\0');
  start.resize(file.bytes().read(std::as_writable_bytes(std::span(start))));
  file.rewind();
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors put it before a text
  if (start.starts_with(kByteOrderMark)) start.erase(0, kByteOrderMark.size());
  static constexpr std::array<std::pair<std::string_view, VolumeFormat>, 9> kStarts{
      {{"NRRD", VolumeFormat::kNrrd},
       {"# vtk DataFile", VolumeFormat::kLegacyVtk},
       {"\x93NUMPY", VolumeFormat::kNpy},
       {"#INRIMAGE-4#{", VolumeFormat::kInr},
       {"PVM", VolumeFormat::kPvm},
       {"DDS v3", VolumeFormat::kPvm},
       {"ObjectType", VolumeFormat::kMetaImage},
       {"NDims", VolumeFormat::kMetaImage},
       {"<VTKFile", VolumeFormat::kVti}}};
  for (const auto& [known, format] : kStarts) {
    if (start.starts_with(known)) return format;
  }
  if (start.starts_with("<?xml") && start.find("<VTKFile") != std::string::npos) return VolumeFormat::kVti;
  const auto has = [&](std::size_t place, std::string_view text) {
    return start.size() > place && std::string_view(start).substr(place).starts_with(text);
  };
  if (has(344, "n+1") || has(344, "ni1") || has(4, "n+2") || has(4, "ni2")) return VolumeFormat::kNifti;
  return has(208, "MAP") ? std::optional(VolumeFormat::kMrc) : std::nullopt;
}

Volume read_as(VolumeFormat format, UnpackedFile& file, const ReadOptions& options) {
  const ChannelChoice choice{options.channel};
  switch (format) {
    case VolumeFormat::kNrrd:
      return read_nrrd(file, choice);
    case VolumeFormat::kNifti:
      return read_nifti(file, choice);
    case VolumeFormat::kMetaImage:
      return read_metaimage(file, choice);
    case VolumeFormat::kLegacyVtk:
      return read_legacy_vtk(file, choice, options.array);
    case VolumeFormat::kVti:
      return read_vti(file, choice, options.array);
    case VolumeFormat::kNpy:
      return read_npy(file, choice);
    case VolumeFormat::kMrc:
      return read_mrc(file, choice);
    case VolumeFormat::kInr:
      return read_inr(file, choice);
    case VolumeFormat::kPvm:
      return read_pvm(file, choice);
    case VolumeFormat::kRaw:
      break;
  }
  return read_raw(file.file().path(), options.raw);
}

Volume read_any(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string extension = options.format.empty() ? lower_case_extension(path) : "." + options.format;
  std::optional<VolumeFormat> format = format_of_extension(extension);
  if (!format && reads_by_itk(path)) return read_by_itk(path, {options.channel});
  std::error_code unreadable;
  if (format || std::filesystem::is_regular_file(path) || !std::filesystem::exists(path, unreadable)) {
    UnpackedFile file(path, options.stands_alone);
    if (!format) format = format_of_content(file);
    if (format) return read_as(*format, file, options);
  }
  const std::string found = extension.empty() ? "has no extension" : "has the extension \"" + extension + "\"";
  throw InputError(path.string() + ": " + found + ", a volume is read from " + std::string(kVolumeExtensions) +
                   converter_hint(path));
}

}  // namespace

bool is_volume_format(const std::string& format) { return format_of_extension("." + format).has_value(); }

Volume read_placed_volume(const std::filesystem::path& path, const ReadOptions& options) {
  Volume volume = read_any(path, options);
  if (volume.as_read && !options.accepts_not_finite) {
    throw InputError(path.string() + ": " + first_not_finite_text(*volume.as_read, volume.grid, {}) +
                     ": every sample must be a finite number");
  }
  return volume;
}

ScalarGrid read_volume(const std::filesystem::path& path, const ReadOptions& options) {
  return read_placed_volume(path, options).grid;
}

void write_volume(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding) {
  write_volume(
      header_of(grid), [&grid] { return grid.samples(); }, path, encoding);
}

void write_volume(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                  NrrdEncoding encoding) {
  // Of a packed file it is the extension of what is packed.
  if (path.extension() == ".gz" || path.extension() == ".GZ")
    throw InputError(path.string() +
                     ": a volume is not written packed as a whole, expected .nrrd, whose samples are packed, or .raw");
  const std::string extension = lower_case_extension(path);
  if (extension == ".nrrd") return write_nrrd(header, next, path, encoding);
  if (extension == ".raw") return write_raw(header, next, path);
  throw InputError(path.string() + ": the extension is \"" + extension + "\", a volume is written to .nrrd or .raw");
}

}  // namespace deliso
