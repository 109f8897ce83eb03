// The reader through ITK (optional): its ImageIO classes give bytes, type and geometry; all else is as for our formats.
#ifdef DELISO_HAS_ITK

#include "volume/io/itk/itk_reader.h"

#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkGDCMImageIOFactory.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkGiplImageIOFactory.h>
#include <itkHDF5ImageIOFactory.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkImageIOFactory.h>
#include <itkImageSeriesReader.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIOFactory.h>
#include <itkNiftiImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>
#include <itkTIFFImageIOFactory.h>
#include <itkVTKImageIOFactory.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "volume/io/base/gzip_stream.h"
#include "volume/io/itk/dicom_pixels.h"

namespace deliso {

namespace {

// A file that has a name and no bytes of its own: for errors.
class NamedFile : public ByteStream {
 public:
  explicit NamedFile(std::string name) : name_(std::move(name)) {}
  std::size_t read(std::span<std::byte> /*out*/) override { return 0; }
  [[nodiscard]] std::uint64_t bound() const override { return 0; }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::string name_;
};

void register_formats() {
  static std::once_flag once;
  std::call_once(once, [] {
    // What they have to say comes as errors, or is none of the user's business.
    itk::Object::GlobalWarningDisplayOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    itk::GDCMImageIOFactory::RegisterOneFactory();
    itk::TIFFImageIOFactory::RegisterOneFactory();
    itk::HDF5ImageIOFactory::RegisterOneFactory();
    itk::GiplImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    itk::NiftiImageIOFactory::RegisterOneFactory();
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::VTKImageIOFactory::RegisterOneFactory();
  });
}

// One sentence of ITK's many lines, without the places of its objects in memory.
std::string sentence_of(const itk::ExceptionObject& error) {
  std::string text = error.GetDescription();
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  for (std::size_t place = text.find("(0x"); place != std::string::npos; place = text.find("(0x", place)) {
    const std::size_t end = text.find(')', place);
    text.erase(place, end == std::string::npos ? end : end - place + 1);
  }
  return text;
}

// A type of ITK's by its size: some of its names differ from machine to machine.
std::optional<StoredType> stored_type_of(const itk::ImageIOBase& io) {
  using Type = itk::IOComponentEnum;
  const Type type = io.GetComponentType();
  if (type == Type::FLOAT) return StoredType::kF32;
  if (type == Type::DOUBLE) return StoredType::kF64;
  const bool is_signed =
      type == Type::CHAR || type == Type::SHORT || type == Type::INT || type == Type::LONG || type == Type::LONGLONG;
  switch (io.GetComponentSize()) {
    case 1:
      return is_signed ? StoredType::kI8 : StoredType::kU8;
    case 2:
      return is_signed ? StoredType::kI16 : StoredType::kU16;
    case 4:
      return is_signed ? StoredType::kI32 : StoredType::kU32;
    case 8:
      return is_signed ? StoredType::kI64 : StoredType::kU64;
    default:
      return std::nullopt;
  }
}

VolumeDescription description_of(const ByteStream& file, const itk::ImageIOBase& io) {
  VolumeDescription volume;
  volume.format = io.GetNameOfClass();
  // A picture says neither.
  if (volume.format != "TIFFImageIO") {
    volume.space = space_name("LPS");
    volume.units = "mm";
  }
  const unsigned axes = io.GetNumberOfDimensions();
  if (axes != 3 && axes != 4) file.fail("the file has " + std::to_string(axes) + " axes, expected 3 or 4");
  for (unsigned n = 0; n < 3; ++n) {
    const auto size = io.GetDimensions(n);
    if (size > std::numeric_limits<std::int32_t>::max() - 2) file.fail("a dimension is " + std::to_string(size));
    volume.layout.dims.at(n) = static_cast<std::int32_t>(size);
    const std::vector<double> direction = io.GetDirection(n);
    volume.index_to_world.columns.at(n) = io.GetSpacing(n) * Vec3{direction[0], direction[1], direction[2]};
    volume.index_to_world.offset[n] = io.GetOrigin(n);
  }
  if (volume.format == "GDCMImageIO" && volume.layout.dims[2] == 1)
    file.fail("the file holds one slice, expected a volume: give the folder of its series");
  if (axes == 4) volume.layout.volumes = io.GetDimensions(3);
  volume.layout.components = io.GetNumberOfComponents();
  const std::optional<StoredType> type = stored_type_of(io);
  if (!type) file.fail("the samples have a type of ITK that is no number of ours");
  volume.layout.type = *type;
  volume.layout.endian = kHostEndian;
  return volume;
}

void check_pixels(const NamedFile& dicom) {
  if (!holds_all_pixels(dicom.name())) dicom.fail("the file ends before its last pixel");
}

// ITK's readers of these formats take what is missing for zeros.
void check_length(const NamedFile& file, const itk::ImageIOBase& io) {
  constexpr std::uint64_t kGiplHeader = 256;
  const std::string format = io.GetNameOfClass();
  if (format == "GDCMImageIO") check_pixels(file);
  if (format != "GiplImageIO") return;
  UnpackedFile unpacked(file.name());
  unpacked.bytes().skip(kGiplHeader + static_cast<std::uint64_t>(io.GetImageSizeInBytes()), "the end of the samples");
}

std::string millimetres(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g mm", length);
  return text.data();
}

// ITK puts the slices at even distances, wherever they are: a missing one, or two at a place, would move the others.
void check_distances_of_slices(const NamedFile& file, const itk::Image<double, 3>& image) {
  constexpr double kMostOff = 0.01;  // of a distance: positions are rounded
  double off = 0;
  const double distance = image.GetSpacing()[2];
  itk::ExposeMetaData(image.GetMetaDataDictionary(), "ITK_non_uniform_sampling_deviation", off);
  if (off > kMostOff * distance)
    file.fail("the slices of the series are up to " + millimetres(off) + " off their mean distance of " +
              millimetres(distance) +
              ", expected even distances: a slice may be missing or double, dcm2niix makes even ones");
}

// The files of each series of a folder. With `by_details` slices of another size, thickness, number or name are a
// series of their own.
std::vector<std::vector<std::string>> all_series(const std::filesystem::path& path, bool by_details) {
  auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(by_details);
  names->SetDirectory(path.string());
  std::vector<std::vector<std::string>> files;
  for (const std::string& series : names->GetSeriesUIDs()) files.push_back(names->GetFileNames(series));
  return files;
}

// The files of the longest series in `all`. A series of which only a part would make a volume is refused.
std::vector<std::string> longest_series(const NamedFile& folder, const std::vector<std::vector<std::string>>& all) {
  const auto is_shorter = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  const std::vector<std::string>& files = *std::max_element(all.begin(), all.end(), is_shorter);
  for (const std::vector<std::string>& whole : all_series(folder.name(), false)) {
    if (std::find(whole.begin(), whole.end(), files.front()) == whole.end() || whole.size() == files.size()) continue;
    folder.fail("of the " + std::to_string(whole.size()) + " slices of the longest series only " +
                std::to_string(files.size()) +
                " have the same size, thickness, series number and sequence name, expected all: copy those of one kind "
                "to a folder of their own");
  }
  for (const std::string& slice : files) check_pixels(NamedFile(slice));
  return files;
}

// A folder of DICOM files: its longest series, as doubles.
Volume read_series(const std::filesystem::path& path, const ChannelChoice& choice) {
  const NamedFile file(path.string());
  using Image = itk::Image<double, 3>;
  const std::vector<std::vector<std::string>> all = all_series(path, true);
  const std::vector<std::string> files = longest_series(file, all);
  auto reader = itk::ImageSeriesReader<Image>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(files);
  reader->ForceOrthogonalDirectionOff();  // slices of a tilted gantry are sheared
  reader->Update();
  const Image& image = *reader->GetOutput();
  check_distances_of_slices(file, image);
  VolumeDescription volume;
  volume.format = all.size() < 2 ? "DICOM" : "DICOM, the longest of " + std::to_string(all.size()) + " series";
  volume.space = space_name("LPS");
  volume.units = "mm";
  volume.layout.type = StoredType::kF64;
  volume.layout.endian = kHostEndian;
  for (unsigned n = 0; n < 3; ++n) {
    volume.layout.dims.at(n) = static_cast<std::int32_t>(image.GetLargestPossibleRegion().GetSize(n));
    for (unsigned row = 0; row < 3; ++row)
      volume.index_to_world.columns.at(n)[row] = image.GetDirection()(row, n) * image.GetSpacing()[n];
    volume.index_to_world.offset[n] = image.GetOrigin()[n];
  }
  const std::size_t bytes = image.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(double);
  MemoryStream samples(file, std::string(reinterpret_cast<const char*>(image.GetBufferPointer()), bytes));
  Volume read = read_described(samples, volume, choice);
  read.data_files.assign(files.begin(), files.end());
  return read;
}

}  // namespace

bool reads_by_itk(const std::filesystem::path& path) {
  register_formats();
  try {
    if (std::filesystem::is_directory(path)) {
      auto names = itk::GDCMSeriesFileNames::New();
      names->SetDirectory(path.string());
      return !names->GetSeriesUIDs().empty();
    }
    if (!std::filesystem::is_regular_file(path)) return false;
    return itk::ImageIOFactory::CreateImageIO(path.string().c_str(), itk::IOFileModeEnum::ReadMode).IsNotNull();
  } catch (const itk::ExceptionObject&) {
    return false;
  }
}

Volume read_by_itk(const std::filesystem::path& path, const ChannelChoice& choice) {
  const NamedFile file(path.string());
  register_formats();
  try {
    if (std::filesystem::is_directory(path)) return read_series(path, choice);
    const auto io = itk::ImageIOFactory::CreateImageIO(path.string().c_str(), itk::IOFileModeEnum::ReadMode);
    if (io.IsNull()) file.fail("ITK does not read this file");
    io->SetFileName(path.string());
    io->ReadImageInformation();
    check_length(file, *io);
    const VolumeDescription volume = description_of(file, *io);
    itk::ImageIORegion region(io->GetNumberOfDimensions());
    for (unsigned n = 0; n < io->GetNumberOfDimensions(); ++n) region.SetSize(n, io->GetDimensions(n));
    io->SetIORegion(region);
    std::string bytes(static_cast<std::size_t>(io->GetImageSizeInBytes()), '\0');
    io->Read(bytes.data());
    MemoryStream samples(file, std::move(bytes));
    return read_described(samples, volume, choice);
  } catch (const itk::ExceptionObject& error) {
    file.fail("ITK says: " + sentence_of(error));
  } catch (const std::bad_alloc&) {
    file.fail("the samples need more memory than there is");
  }
}

}  // namespace deliso

#endif
