// Binary glTF 2.0 (Khronos): a JSON chunk that describes the data of a binary chunk. Positions and normals are floats.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"

namespace deliso {

namespace {

// Positions count from here, in units of the mesh.
Vec3 glb_middle(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return {};
  Box3 box;
  for (const Vec3& p : mesh.points) box.extend(p);
  return 0.5 * box.low + 0.5 * box.high;
}

// The mean of the normals of the triangles at each vertex, weighted by their angles there (Thuermer and Wuethrich,
// Computing vertex normals from polygonal facets, 1998); (0, 0, 1) at a vertex without one.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[triangle[i]];
      const Vec3 a = mesh.points[triangle[(i + 1) % 3]] - p, b = mesh.points[triangle[(i + 2) % 3]] - p;
      const Vec3 normal = cross(a, b);
      const double length = norm_of_any_size(normal);
      if (!(length > 0) || !std::isfinite(length)) continue;
      normals[triangle[i]] += std::atan2(length, dot(a, b)) / length * normal;
    }
  }
  for (Vec3& normal : normals) {
    const double length = norm(normal);
    normal = length > 0 && std::isfinite(length) ? normal / length : Vec3{0, 0, 1};
  }
  return normals;
}

// A text in JSON's quotes; bytes that are not ASCII may be no UTF-8 and become question marks.
std::string in_json(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c >= ' ' && c < '\x7F' ? c : '?';
  }
  return out + '"';
}

std::string array_text(const Vec3& v) {
  return "[" + shortest_text(v.x) + "," + shortest_text(v.y) + "," + shortest_text(v.z) + "]";
}

// Where the parts of the binary chunk begin and end.
struct GlbLayout {
  std::size_t positions = 0, normals = 0, indices = 0, end = 0;
  explicit GlbLayout(const TriangleMesh& mesh)
      : normals(12 * mesh.points.size()), indices(24 * mesh.points.size()), end(indices + 12 * mesh.triangles.size()) {}
};

std::string buffer_view(std::size_t begin, std::size_t end, int target) {
  return "{\"buffer\":0,\"byteOffset\":" + std::to_string(begin) + ",\"byteLength\":" + std::to_string(end - begin) +
         ",\"target\":" + std::to_string(target) + "}";
}

std::string asset_json(const MeshComments& comments) {
  std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"DelIso\"";
  if (comments.empty()) return json + "}";
  json += ",\"extras\":{\"comments\":[";
  for (const std::string& comment : comments) json += (json.back() == '[' ? "" : ",") + in_json(comment);
  return json + "]}}";
}

// `box`: of the positions, as floats.
std::string glb_json(const TriangleMesh& mesh, const MeshFileOptions& options, const Box3& box, const Vec3& middle) {
  constexpr int kVertexData = 34962, kIndexData = 34963, kFloat = 5126, kUint32 = 5125;
  std::string json = asset_json(options.comments);
  if (mesh.triangles.empty()) return json + ",\"scene\":0,\"scenes\":[{}]}";
  const GlbLayout layout(mesh);
  const std::string vertices = std::to_string(mesh.points.size());
  json += ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":\"isosurface\",\"mesh\":0,\"translation\":" +
          array_text(middle) + "}]";
  json +=
      ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2,\"material\":0}]}]";
  json +=
      ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.8,0.8,0.8,1],\"metallicFactor\":0,"
      "\"roughnessFactor\":0.7},\"doubleSided\":true}]";
  json += ",\"accessors\":[{\"bufferView\":0,\"componentType\":" + std::to_string(kFloat) + ",\"count\":" + vertices +
          ",\"type\":\"VEC3\",\"min\":" + array_text(box.low) + ",\"max\":" + array_text(box.high) + "}";
  json += ",{\"bufferView\":1,\"componentType\":" + std::to_string(kFloat) + ",\"count\":" + vertices +
          ",\"type\":\"VEC3\"}";
  json += ",{\"bufferView\":2,\"componentType\":" + std::to_string(kUint32) +
          ",\"count\":" + std::to_string(3 * mesh.triangles.size()) + ",\"type\":\"SCALAR\"}]";
  json += ",\"bufferViews\":[" + buffer_view(0, layout.normals, kVertexData) + "," +
          buffer_view(layout.normals, layout.indices, kVertexData) + "," +
          buffer_view(layout.indices, layout.end, kIndexData) + "]";
  return json + ",\"buffers\":[{\"byteLength\":" + std::to_string(layout.end) + "}]}";
}

void append_floats(std::string& bytes, const Vec3& v) {
  for (const double c : {v.x, v.y, v.z}) append_little_endian(bytes, static_cast<float>(c));
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view data, char padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  append_little_endian(bytes, static_cast<std::uint32_t>(padded));
  append_little_endian(bytes, type);
  bytes += data;
  bytes.append(padded - data.size(), padding);
}

// What a vertex is in the file, before its rounding to floats.
Vec3 glb_position(const Vec3& p, const Vec3& middle, double metres) { return metres * (p - middle); }

float rounded_to_float(double value) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  if (std::abs(value) <= kMost) return static_cast<float>(value);
  return value > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
}

}  // namespace

std::vector<Vec3> glb_points(const TriangleMesh& mesh, std::optional<double> metres) {
  const Vec3 middle = glb_middle(mesh);
  const double unit = metres.value_or(1);
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points) {
    const Vec3 q = glb_position(p, middle, unit);
    const Vec3 floats{static_cast<double>(rounded_to_float(q.x)), static_cast<double>(rounded_to_float(q.y)),
                      static_cast<double>(rounded_to_float(q.z))};
    points.push_back(floats / unit + middle);
  }
  return points;
}

std::string glb_bytes(const TriangleMesh& mesh, const MeshFileOptions& options, const std::string& name) {
  const double metres = options.metres.value_or(1);
  const Vec3 middle = glb_middle(mesh);
  Box3 box;
  std::string data;
  const GlbLayout layout(mesh);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - (std::size_t{1} << 20);
  if (layout.end > kMost)
    throw InputError(name + ": GLB holds up to 4 GiB, the mesh has " + std::to_string(mesh.triangles.size()) +
                     " triangles: write .ply or .vtp");
  data.reserve(layout.end);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3 p = glb_position(mesh.points[v], middle, metres);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(rounded_to_float(p[axis])))
        throw InputError(name + ": GLB holds floats, and a coordinate of vertex " + std::to_string(v) +
                         " is beyond their range: " + shortest_text(p[axis]));
    }
    append_floats(data, p);
    box.extend({static_cast<double>(static_cast<float>(p.x)), static_cast<double>(static_cast<float>(p.y)),
                static_cast<double>(static_cast<float>(p.z))});
  }
  for (const Vec3& normal : vertex_normals(mesh)) append_floats(data, normal);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) append_little_endian(data, v);
  }
  constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  std::string chunks;
  append_chunk(chunks, kJson, glb_json(mesh, options, box, metres * middle), ' ');
  if (!mesh.triangles.empty()) append_chunk(chunks, kBinary, data, '\0');
  std::string bytes;
  for (const std::uint32_t number : {kMagic, kVersion, static_cast<std::uint32_t>(12 + chunks.size())})
    append_little_endian(bytes, number);
  return bytes + chunks;
}

}  // namespace deliso
