#include "surface/mesh/io/mesh_io.h"

#include <cctype>
#include <optional>
#include <span>
#include <string>

#include "delaunay/base/check.h"
#include "surface/mesh/io/formats.h"
#include "volume/io/base/atomic_file.h"
#include "volume/io/base/input_file.h"

namespace deliso {

namespace {

enum class Format { kPly, kOff, kObj, kStl };

std::optional<Format> known_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return Format::kPly;
  if (extension == ".off") return Format::kOff;
  if (extension == ".obj") return Format::kObj;
  if (extension == ".stl") return Format::kStl;
  return std::nullopt;
}

Format format_of(const std::filesystem::path& path) {
  const std::optional<Format> format = known_format(path);
  if (format) return *format;
  throw InputError(path.string() + ": a mesh file needs the extension " + std::string(kMeshExtensions) + ", found '" +
                   path.extension().string() + "'");
}

// Whole or not at all, so that no reader ever sees half a file.
void write_whole(const std::string& bytes, const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::string read_whole(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes(file.remaining(), '\0');
  bytes.resize(file.read(std::as_writable_bytes(std::span(bytes))));
  return bytes;
}

}  // namespace

bool is_mesh_path(const std::filesystem::path& path) { return known_format(path).has_value(); }

bool keeps_floats(const std::filesystem::path& path) { return known_format(path) == Format::kStl; }

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, bool ascii,
                const std::vector<std::string>& comments) {
  switch (format_of(path)) {
    case Format::kPly:
      return write_whole(ply_bytes(mesh, ascii, comments), path);
    case Format::kOff:
      return write_whole(off_bytes(mesh, comments), path);
    case Format::kObj:
      return write_whole(obj_bytes(mesh, comments), path);
    case Format::kStl:
      return write_whole(stl_bytes(mesh, ascii, path.string(), comments), path);
  }
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const Format format = format_of(path);
  const std::string bytes = read_whole(path);
  switch (format) {
    case Format::kPly:
      return parse_ply(bytes, path.string());
    case Format::kOff:
      return parse_off(bytes, path.string());
    case Format::kObj:
      return parse_obj(bytes, path.string());
    case Format::kStl:
      return parse_stl(bytes, path.string());
  }
  return {};
}

}  // namespace deliso
