#include "surface/mesh_io.h"

#include <unistd.h>

#include <cctype>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "delaunay/base/check.h"
#include "surface/mesh_io_formats.h"

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

// Writes a temporary file beside `path` and renames it, so that no reader ever sees half a file.
void write_whole(const std::string& bytes, const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  std::error_code error;
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out) throw InputError(path.string() + ": cannot write here (no such directory, or no permission)");
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      std::filesystem::remove(temporary, error);
      throw InputError(path.string() + ": cannot write " + std::to_string(bytes.size()) + " bytes (is the disk full?)");
    }
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    throw InputError(path.string() + ": cannot write this file: " + why);
  }
}

std::string read_whole(const std::filesystem::path& path) {
  constexpr std::size_t kChunk = std::size_t{1} << 22;
  std::ifstream in(path, std::ios::binary);
  std::string bytes;
  for (std::size_t size = 0; in; bytes.resize(size)) {
    bytes.resize(size + kChunk);
    in.read(bytes.data() + size, kChunk);
    size += static_cast<std::size_t>(in.gcount());
  }
  // A directory opens but does not read; whole files end with eof and fail, never bad.
  if (!in.eof() || in.bad()) throw InputError(path.string() + ": cannot read this file");
  return bytes;
}

}  // namespace

bool is_mesh_path(const std::filesystem::path& path) { return known_format(path).has_value(); }

bool keeps_floats(const std::filesystem::path& path) { return known_format(path) == Format::kStl; }

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, bool ascii) {
  switch (format_of(path)) {
    case Format::kPly:
      return write_whole(ply_bytes(mesh, ascii), path);
    case Format::kOff:
      return write_whole(off_bytes(mesh), path);
    case Format::kObj:
      return write_whole(obj_bytes(mesh), path);
    case Format::kStl:
      return write_whole(stl_bytes(mesh, ascii), path);
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
