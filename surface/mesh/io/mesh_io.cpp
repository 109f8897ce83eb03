#include "surface/mesh/io/mesh_io.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "delaunay/base/check.h"
#include "surface/mesh/io/comments.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"
#include "volume/io/base/atomic_file.h"
#include "volume/io/base/input_file.h"

namespace deliso {

namespace {

struct FormatNames {
  MeshFormat format;
  std::string_view extension;  // without its dot
  std::string_view name;
};

constexpr std::size_t kHead = 4096;  // bytes that tell a format

constexpr std::array<FormatNames, 10> kFormats = {{{MeshFormat::kPly, "ply", "PLY"},
                                                   {MeshFormat::kOff, "off", "OFF"},
                                                   {MeshFormat::kObj, "obj", "OBJ"},
                                                   {MeshFormat::kStl, "stl", "STL"},
                                                   {MeshFormat::kMedit, "mesh", "Medit"},
                                                   {MeshFormat::kLegacyVtk, "vtk", "VTK"},
                                                   {MeshFormat::kVtp, "vtp", "VTP"},
                                                   {MeshFormat::kGmsh, "msh", "Gmsh"},
                                                   {MeshFormat::kSmesh, "smesh", "TetGen"},
                                                   {MeshFormat::kGlb, "glb", "GLB"}}};

[[noreturn]] void fail_extension(const std::filesystem::path& path, std::string_view expected) {
  throw InputError(path.string() + ": a mesh file needs the extension " + std::string(expected) + ", found '" +
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

TriangleMesh parsed(std::string_view bytes, MeshFormat format, const std::string& name, MeshComments& comments) {
  switch (format) {
    case MeshFormat::kPly:
      return parse_ply(bytes, name);
    case MeshFormat::kOff:
      return parse_off(bytes, name);
    case MeshFormat::kObj:
      return parse_obj(bytes, name);
    case MeshFormat::kStl:
      return parse_stl(bytes, name);
    case MeshFormat::kMedit:
      return parse_medit(bytes, name);
    case MeshFormat::kLegacyVtk:
      return parse_legacy_vtk(bytes, name, &comments);
    case MeshFormat::kVtp:
      return parse_vtp(bytes, name, &comments);
    case MeshFormat::kGmsh:
    case MeshFormat::kSmesh:
    case MeshFormat::kGlb:
      break;
  }
  throw InputError(name + ": " + std::string(name_of(format)) + " meshes are written only, expected " +
                   std::string(kReadMeshExtensions));
}

}  // namespace

std::optional<MeshFormat> mesh_format_named(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.extension == lower; });
  return found == kFormats.end() ? std::nullopt : std::optional(found->format);
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension.empty() ? std::nullopt : mesh_format_named(std::string_view(extension).substr(1));
}

std::optional<MeshFormat> mesh_format_of_content(std::string_view head, std::uint64_t size) {
  head = head.substr(0, kHead);
  const auto has = [&](std::string_view text) { return head.find(text) != std::string_view::npos; };
  if (head.starts_with("ply\n") || head.starts_with("ply\r\n")) return MeshFormat::kPly;
  if (head.starts_with("# vtk DataFile") && (has("POLYDATA") || has("polydata"))) return MeshFormat::kLegacyVtk;
  if (has("<VTKFile") && has("PolyData")) return MeshFormat::kVtp;
  if (head.starts_with("MeshVersionFormatted")) return MeshFormat::kMedit;
  if (may_be_ascii_stl(head)) return MeshFormat::kStl;
  if (is_binary_stl(head, size)) return MeshFormat::kStl;
  const std::string_view word = head.substr(0, head.find_first_of(" \r\n"));
  if (word.ends_with("OFF")) return MeshFormat::kOff;
  return begins_as_obj(head) ? std::optional(MeshFormat::kObj) : std::nullopt;
}

bool is_read(MeshFormat format) {
  return format != MeshFormat::kGmsh && format != MeshFormat::kSmesh && format != MeshFormat::kGlb;
}

bool is_packed_mesh_path(const std::filesystem::path& path) {
  if (!same_letters(path.extension().string(), ".GZ")) return false;
  const std::optional<MeshFormat> packed = mesh_format_of(path.stem());
  return packed && *packed != MeshFormat::kLegacyVtk;
}

bool is_mesh_path(const std::filesystem::path& path) { return mesh_format_of(path).has_value(); }

bool is_mesh_content(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  InputFile file(path);
  std::string head(kHead, '\0');
  head.resize(file.read(std::as_writable_bytes(std::span(head))));
  return mesh_format_of_content(head, file.size()).has_value();
}

bool keeps_floats(MeshFormat format) { return format == MeshFormat::kStl || format == MeshFormat::kGlb; }

TriangleMesh as_stored(TriangleMesh mesh, MeshFormat format, std::optional<double> metres) {
  if (format == MeshFormat::kStl) mesh.points = stl_points(mesh);
  if (format == MeshFormat::kGlb) mesh.points = glb_points(mesh, metres);
  return mesh;
}

std::string mesh_bytes(const TriangleMesh& mesh, MeshFormat format, const MeshFileOptions& options,
                       const std::string& name) {
  switch (format) {
    case MeshFormat::kPly:
      return ply_bytes(mesh, options.ascii, options.comments);
    case MeshFormat::kOff:
      return off_bytes(mesh, options.comments);
    case MeshFormat::kObj:
      return obj_bytes(mesh, options.comments);
    case MeshFormat::kStl:
      return stl_bytes(mesh, options.ascii, name, options.comments);
    case MeshFormat::kMedit:
      return medit_bytes(mesh, options);
    case MeshFormat::kLegacyVtk:
      return legacy_vtk_bytes(mesh, options);
    case MeshFormat::kVtp:
      return vtp_bytes(mesh, options);
    case MeshFormat::kGmsh:
      return gmsh_bytes(mesh, options, name);
    case MeshFormat::kSmesh:
      return smesh_bytes(mesh, options);
    case MeshFormat::kGlb:
      return glb_bytes(mesh, options, name);
  }
  return {};
}

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  const std::optional<MeshFormat> format = options.format ? options.format : mesh_format_of(path);
  if (!format) fail_extension(path, kMeshExtensions);
  write_whole(mesh_bytes(mesh, *format, options, path.string()), path);
}

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, bool ascii,
                const std::vector<std::string>& comments) {
  MeshFileOptions options;
  options.ascii = ascii;
  options.comments = comments;
  write_mesh(mesh, path, options);
}

MeshFile parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name) {
  MeshFile file;
  file.format = format;
  file.mesh = parsed(bytes, format, name, file.comments);
  if (format != MeshFormat::kLegacyVtk && format != MeshFormat::kVtp) file.comments = comments_of(bytes, format);
  return file;
}

MeshFile read_mesh_file(const std::filesystem::path& path, std::optional<MeshFormat> format) {
  if (!format && is_packed_mesh_path(path))
    throw InputError(path.string() + ": meshes are not read packed, expected the unpacked file (as by gunzip)");
  if (!format) format = mesh_format_of(path);
  if (format && !is_read(*format)) return parse_mesh("", *format, path.string());  // throws
  if (!format && !std::filesystem::is_regular_file(path)) fail_extension(path, kReadMeshExtensions);
  const std::string bytes = read_whole(path);
  if (!format) format = mesh_format_of_content(bytes, bytes.size());
  if (!format) fail_extension(path, kReadMeshExtensions);
  return parse_mesh(bytes, *format, path.string());
}

TriangleMesh read_mesh(const std::filesystem::path& path) { return read_mesh_file(path).mesh; }

std::string_view name_of(MeshFormat format) {
  return std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.format == format; })->name;
}

}  // namespace deliso
