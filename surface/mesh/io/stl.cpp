// STL: triangles without connectivity. Corners with equal coordinates become one vertex, numbered as they first appear.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

constexpr std::size_t kHeaderSize = kStlHeaderLetters + 4;  // the text and the number of triangles
constexpr std::size_t kRecordSize = 50;                     // normal, three corners (floats), two bytes of attributes

struct PointHash {
  std::size_t operator()(const Vec3& p) const noexcept {
    std::uint64_t h = 0;
    for (const double c : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 32;
    }
    return h;
  }
};

// Gathers corners into an indexed mesh.
class CornerMerger {
 public:
  void reserve(std::size_t triangles) {
    mesh_.triangles.reserve(triangles);
    vertex_at_.reserve(triangles / 2);
  }
  void add(const std::array<Vec3, 3>& corners) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = corners[i] + Vec3{0, 0, 0};  // -0 becomes 0, so that equal points have equal bits
      const auto [place, is_new] = vertex_at_.try_emplace(p, static_cast<std::uint32_t>(mesh_.points.size()));
      if (is_new) mesh_.points.push_back(p);
      triangle[i] = place->second;
    }
    mesh_.triangles.push_back(triangle);
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  TriangleMesh mesh_;
  std::unordered_map<Vec3, std::uint32_t, PointHash> vertex_at_;
};

Vec3 normal_of(const std::array<Vec3, 3>& corners) {
  const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = norm(n);
  return length > 0 && std::isfinite(length) ? n / length : Vec3{0, 0, 0};
}

// The comments as one line, but for those for which there is no room: half of one might say something else.
std::string joined(const MeshComments& comments, std::size_t most = std::string::npos) {
  std::string line;
  for (const std::string& comment : comments) {
    const std::string text = (line.empty() ? "" : "; ") + comment;
    if (text.size() <= most - line.size()) line += text;
  }
  return line;
}

float nearest_float(double value) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  if (std::abs(value) <= kMost) return static_cast<float>(value) + 0.0f;  // -0 becomes 0
  return value > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
}

// The points whose coordinates are nearest floats, or floats next to these: the nearest point first.
std::vector<Vec3> float_points_around(const Vec3& p) {
  std::vector<Vec3> points;
  std::array<std::array<double, 3>, 3> choices{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float nearest = nearest_float(p[axis]);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    choices[axis] = {static_cast<double>(nearest), static_cast<double>(std::nextafter(nearest, -kInfinity) + 0.0f),
                     static_cast<double>(std::nextafter(nearest, kInfinity) + 0.0f)};
  }
  for (const double x : choices[0]) {
    for (const double y : choices[1]) {
      for (const double z : choices[2]) points.push_back({x, y, z});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [&](const Vec3& a, const Vec3& b) { return squared_distance(a, p) < squared_distance(b, p); });
  return points;
}

// The mesh with its points as they are stored.
// Numbers of single precision, in as many digits as those of double precision need: with the few that tell floats
// apart, readers that take doubles would have other points, and triangles that cross.
std::string ascii_bytes(const TriangleMesh& mesh, const MeshComments& comments) {
  std::string text = "solid deliso" + std::string(comments.empty() ? "" : " ") + joined(comments) + "\n";
  const auto append = [&](const char* keyword, const Vec3& p) {
    text += keyword;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, static_cast<double>(static_cast<float>(p[axis])));
    }
    text += '\n';
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Vec3, 3> corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    append("facet normal", normal_of(corners));
    text += "outer loop\n";
    for (const Vec3& p : corners) append("vertex", p);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid deliso\n";
}

TriangleMesh parse_binary(std::string_view bytes, const std::string& file) {
  ByteReader in(bytes, file, std::endian::little);
  in.skip(kHeaderSize - 4, "the header");
  const auto count = in.read<std::uint32_t>("the number of triangles");
  if (bytes.size() != kHeaderSize + kRecordSize * count) {
    throw InputError(file + ": expected " + std::to_string(kHeaderSize + kRecordSize * count) + " bytes for " +
                     std::to_string(count) + " triangles, found " + std::to_string(bytes.size()));
  }
  CornerMerger merger;
  merger.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    in.skip(12, "a normal");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] = static_cast<double>(in.read<float>("a coordinate"));
      if (!is_finite(corner)) in.fail("finite coordinates");
    }
    in.skip(2, "the attributes");
    merger.add(corners);
  }
  return merger.take();
}

TriangleMesh parse_ascii(std::string_view bytes, const std::string& file) {
  TextScanner in(bytes, file);
  // Some programs write the keywords in capitals.
  const auto expect = [&](const char* capitals, const char* keyword) {
    const std::string_view found = in.word();
    if (!same_letters(found, capitals)) in.fail(keyword, found);
  };
  CornerMerger merger;
  // Facets; several solids may follow each other. The first line is "solid" and a name.
  bool inside = false;
  for (std::string_view keyword = in.word(); !keyword.empty(); keyword = in.word()) {
    if (same_letters(keyword, inside ? "ENDSOLID" : "SOLID")) {
      inside = !inside;
      in.next_line();
      continue;
    }
    if (!inside || !same_letters(keyword, "FACET")) in.fail(inside ? "facet or endsolid" : "solid", keyword);
    in.next_line();  // the normal
    expect("OUTER", "outer");
    expect("LOOP", "loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("VERTEX", "vertex");
      corner = in.point();
    }
    expect("ENDLOOP", "endloop");
    expect("ENDFACET", "endfacet");
    merger.add(corners);
  }
  if (inside) in.fail("endsolid", "");
  return merger.take();
}

}  // namespace

std::vector<Vec3> stl_points(const TriangleMesh& mesh) {
  // The first vertex at a place keeps it; others move on to a free one beside it.
  std::vector<Vec3> points;
  points.reserve(mesh.points.size());
  std::unordered_set<Vec3, PointHash> taken;
  std::vector<std::size_t> late;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    points.push_back({static_cast<double>(nearest_float(p.x)), static_cast<double>(nearest_float(p.y)),
                      static_cast<double>(nearest_float(p.z))});
    if (!taken.insert(points.back()).second && is_finite(points.back())) late.push_back(v);
  }
  for (const std::size_t v : late) {
    for (const Vec3& p : float_points_around(mesh.points[v])) {
      if (!is_finite(p) || !taken.insert(p).second) continue;
      points[v] = p;
      break;
    }
  }
  return points;
}

std::string stl_bytes(const TriangleMesh& exact, bool ascii, const std::string& name, const MeshComments& comments) {
  const TriangleMesh mesh{stl_points(exact), exact.triangles};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::isfinite(mesh.points[v][axis])) continue;
      throw InputError(name + ": STL holds floats, and a coordinate of vertex " + std::to_string(v) +
                       " is beyond their range: " + shortest_text(exact.points[v][axis]));
    }
  }
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(name + ": STL holds fewer than 2^32 triangles, found " + std::to_string(mesh.triangles.size()));
  }
  if (ascii) return ascii_bytes(mesh, comments);

  std::string bytes = joined(comments, kHeaderSize - 4);
  if (bytes.empty()) bytes = "DelIso";
  if (bytes.starts_with("solid")) bytes = "DelIso";  // it would pass for text
  bytes.reserve(kHeaderSize + kRecordSize * mesh.triangles.size());
  bytes.resize(kHeaderSize - 4, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Vec3, 3> corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    for (const Vec3& p : {normal_of(corners), corners[0], corners[1], corners[2]}) {
      for (std::size_t axis = 0; axis < 3; ++axis) append_little_endian(bytes, static_cast<float>(p[axis]));
    }
    append_little_endian(bytes, std::uint16_t{0});
  }
  return bytes;
}

bool is_binary_stl(std::string_view head, std::uint64_t size) {
  if (head.size() < kHeaderSize) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, head.data() + kHeaderSize - 4, 4);
  if constexpr (std::endian::native == std::endian::big) count = byte_swapped(count);
  return size == kHeaderSize + kRecordSize * std::uint64_t{count};
}

TriangleMesh parse_stl(std::string_view bytes, const std::string& file) {
  // A binary file may begin with "solid" (or "SOLID") too; only its size tells for sure.
  if (is_binary_stl(bytes, bytes.size())) return parse_binary(bytes, file);
  return same_letters(bytes.substr(0, 5), "SOLID") ? parse_ascii(bytes, file) : parse_binary(bytes, file);
}

}  // namespace deliso
