#include "volume/io/nrrd/nrrd_header.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "volume/io/nrrd/nrrd_axes.h"
#include "volume/io/nrrd/nrrd_data_files.h"
#include "volume/io/nrrd/nrrd_fields.h"

namespace deliso {

namespace {

StoredType read_type(const NrrdFields& fields) {
  const NrrdField& field = fields.required("type");
  const std::optional<StoredType> type = parse_stored_type(field.value);
  if (!type) fields.fail_value(field, supported_sample_types());
  return *type;
}

NrrdData read_encoding(const NrrdFields& fields) {
  const NrrdField& field = fields.required("encoding");
  const std::string name = in_small_letters(field.value);
  if (name == "raw") return NrrdData::kRaw;
  if (name == "gzip" || name == "gz") return NrrdData::kGzip;
  if (name == "text" || name == "txt" || name == "ascii") return NrrdData::kText;
  if (name == "hex") return NrrdData::kHex;
  fields.fail_value(field, "raw, gzip, text or hex");
}

// The byte order may be left out only for samples of one byte, and for text.
Endian read_endian(const NrrdFields& fields, StoredType type, NrrdData encoding) {
  const NrrdField* field = fields.find("endian");
  if (field == nullptr || encoding == NrrdData::kText) {
    if (stored_size(type) == 1 || encoding == NrrdData::kText) return kHostEndian;
    fields.fail("the header has no field \"endian\", which samples of more than one byte need");
  }
  const std::string name = in_small_letters(field->value);
  if (name == "little") return Endian::kLittle;
  if (name == "big") return Endian::kBig;
  fields.fail_value(*field, "little or big");
}

// Checks fields that we do not use; a wrong value there shows that the header is damaged.
void check_unused_fields(const NrrdFields& fields, const NrrdAxes& axes) {
  for (const char* name : {"kinds", "thicknesses"}) {
    if (const NrrdField* field = fields.find(name)) static_cast<void>(fields.words(*field, axes.count));
  }
  const NrrdField* dimension = fields.find("space dimension");
  if (dimension != nullptr && fields.integer(*dimension, dimension->value) != 3) {
    fields.fail_value(*dimension, "3, as the vectors of a volume have");
  }
}

// What stands between quotes, in order.
std::vector<std::string> quoted_names(const std::string& text) {
  std::vector<std::string> names;
  std::size_t start = text.find('"');
  while (start != std::string::npos) {
    const std::size_t end = text.find('"', start + 1);
    if (end == std::string::npos) break;
    names.push_back(text.substr(start + 1, end - start - 1));
    start = text.find('"', end + 1);
  }
  return names;
}

// Those of the space or, where there are none, of the volume's axes. One unit for all axes; several stay named, so that
// nobody takes the volume for one without units.
std::string read_units(const NrrdFields& fields, const NrrdAxes& axes) {
  std::vector<std::string> names;
  if (const NrrdField* of_space = fields.find("space units")) {
    names = quoted_names(of_space->value);
  } else if (const NrrdField* of_axes = fields.find("units")) {
    names = quoted_names(of_axes->value);
    if (names.size() != axes.count) return {};
    names = {names.begin() + std::ptrdiff_t(axes.first), names.begin() + std::ptrdiff_t(axes.first + 3)};
  }
  std::string units;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty() || std::find(names.begin(), name, *name) != name) continue;
    units += (units.empty() ? "" : ", ") + *name;
  }
  return units;
}

void read_place_of_data(const NrrdFields& fields, const std::filesystem::path& path, NrrdHeader& header) {
  if (const NrrdField* field = fields.find("data file")) {
    const SampleLayout& layout = header.volume.layout;
    const std::uint64_t most = std::uint64_t{sample_count_of(fields.file(), layout.dims)} * layout.components;
    header.data_files = nrrd_data_files(fields, *field, path.parent_path(), most);
  } else if (lower_case_extension(path) == ".nhdr") {
    fields.fail("the header has no field \"data file\"");
  } else if (!fields.ended_by_blank_line()) {
    fields.fail("the file ends within the header: no blank line and no data follow");
  }
  if (const NrrdField* field = fields.find("line skip")) {
    const std::int64_t lines = fields.integer(*field, field->value);
    if (lines < 0) fields.fail_value(*field, "0 or more");
    header.skipped_lines = static_cast<std::uint64_t>(lines);
  }
  if (const NrrdField* field = fields.find("byte skip")) {
    const std::int64_t bytes = fields.integer(*field, field->value);
    const bool is_binary = header.encoding == NrrdData::kRaw || header.encoding == NrrdData::kGzip;
    header.skip_from_end = bytes == -1 && is_binary;
    if (bytes < 0 && !header.skip_from_end)
      fields.fail_value(*field, "0 or more (or -1 with the encoding raw or gzip)");
    header.skipped_bytes = header.skip_from_end ? 0 : static_cast<std::uint64_t>(bytes);
  }
}

}  // namespace

NrrdHeader read_nrrd_header(ByteStream& bytes, const std::filesystem::path& path) {
  const NrrdFields fields(bytes);
  const NrrdAxes axes = read_nrrd_axes(fields);
  NrrdHeader header;
  SampleLayout& layout = header.volume.layout;
  layout.dims = axes.dims;
  layout.components = axes.components;
  layout.volumes = axes.volumes;
  layout.type = read_type(fields);
  header.encoding = read_encoding(fields);
  layout.endian = read_endian(fields, layout.type, header.encoding);
  check_unused_fields(fields, axes);
  header.volume.index_to_world = read_nrrd_geometry(fields, axes);
  if (const NrrdField* space = fields.find("space")) header.volume.space = space_name(space->value);
  header.volume.units = read_units(fields, axes);
  header.volume.format = "NRRD";
  read_place_of_data(fields, path, header);
  return header;
}

}  // namespace deliso
