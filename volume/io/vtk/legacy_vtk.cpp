#include "volume/io/vtk/legacy_vtk.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "volume/io/base/text_samples.h"
#include "volume/io/vtk/array_choice.h"
#include "volume/io/vtk/legacy_file.h"

namespace deliso {

namespace {

// Colours in text are bytes as fractions of 255.
std::string bytes_of_colors(ByteStream& stream, std::uint64_t count) {
  const std::string numbers = bytes_of_numbers(stream, StoredType::kF32, count, true);
  std::string out;
  for (std::size_t place = 0; place < numbers.size(); place += sizeof(float)) {
    float fraction = 0;
    std::memcpy(&fraction, numbers.data() + place, sizeof fraction);
    if (!(fraction >= 0 && fraction <= 1)) stream.fail("COLOR_SCALARS has a number that is not from 0 to 1");
    out += static_cast<char>(static_cast<std::uint8_t>(std::lround(fraction * 255.0f)));
  }
  return out;
}

bool is_of_samples(const LegacyArray& array) { return array.is_of_points && array.kind == LegacyArray::Kind::kNumbers; }

}  // namespace

Volume read_legacy_vtk(UnpackedFile& file, const ChannelChoice& choice, const std::string& array) {
  // First the names of all arrays, then the one.
  std::vector<LegacyArray> arrays;
  {
    VolumeDescription ignored;
    LegacyFile legacy(file.bytes(), ignored);
    while (std::optional<LegacyArray> next = legacy.next()) {
      legacy.skip(*next);
      arrays.push_back(std::move(*next));
    }
  }
  std::vector<std::string> names;
  for (const LegacyArray& each : arrays) {
    if (is_of_samples(each)) names.push_back(each.name);
  }
  const std::string name = names.at(choose_array(file.bytes(), names, array));
  file.rewind();
  VolumeDescription volume;
  volume.format = "VTK";
  LegacyFile legacy(file.bytes(), volume);
  std::optional<LegacyArray> found = legacy.next();
  for (; found && !(is_of_samples(*found) && found->name == name); found = legacy.next()) legacy.skip(*found);
  ByteStream& bytes = file.bytes();
  if (!found) bytes.fail("the file has no array " + in_quotes(name));
  SampleLayout& layout = volume.layout;
  if (found->tuples != sample_count_of(bytes, layout.dims))
    bytes.fail("the array " + in_quotes(name) + " has " + std::to_string(found->tuples) +
               " values, but DIMENSIONS needs " + std::to_string(sample_count_of(bytes, layout.dims)));
  layout.type = found->type;
  layout.components = found->components;
  layout.endian = Endian::kBig;
  layout.may_go_on = true;
  if (!legacy.is_text()) return read_described(bytes, volume, choice, file.mappable());
  layout.endian = kHostEndian;
  choose_channel(bytes, choice, layout);
  const std::uint64_t numbers = found->tuples * found->components;
  MemoryStream text(
      bytes, found->is_color ? bytes_of_colors(bytes, numbers) : bytes_of_numbers(bytes, layout.type, numbers, true));
  return read_described(text, volume, choice);
}

}  // namespace deliso
