// Small grids through the whole pipeline: of every sample type, with any spacing, isovalue and boundary. Where the
// mesher says "proven", the verifier must say so, too; a run that stopped early still leaves a manifold mesh.
//
// With DELISO_FUZZ_KEEP=FILE.nrrd in the environment the volume is written there, and the command that meshes it to
// stderr.
// With DELISO_FUZZ_NOTE=1 the two may disagree; it is noted on stderr.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "surface/certificate/certificate.h"
#include "surface/deliso.h"
#include "surface/verification/verification.h"
#include "tests/fuzz/fuzz_input.h"
#include "volume/io/volume_file.h"
#include "volume/sample_type.h"

namespace deliso::fuzz {
namespace {

// Reads an input byte by byte; zeros follow its end.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint8_t next() {
    if (bytes_.empty()) return 0;
    const std::uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  template <class Number>
  Number number() {
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    for (std::uint8_t& byte : bytes) byte = next();
    return std::bit_cast<Number>(bytes);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

// How a sample is made of bytes: few values, all of them, or (for floats) magnitudes far apart.
template <class Sample>
Sample sample_of(Bytes& bytes, unsigned kind) {
  constexpr unsigned kKinds = 4, kFew = 4;
  if (kind % kKinds == 0) return static_cast<Sample>(bytes.next() % kFew);
  if constexpr (std::is_integral_v<Sample>) {
    return kind % kKinds == 1 ? static_cast<Sample>(bytes.next()) : bytes.number<Sample>();
  } else {
    const std::uint8_t byte = bytes.next();
    if (kind % kKinds == 1) return static_cast<Sample>(byte) / 16 - 8;
    if (kind % kKinds == 2) {
      constexpr int kDecades = 25;
      const double magnitude = std::pow(10.0, byte / 2 % kDecades - kDecades / 2);
      return static_cast<Sample>((byte & 1u) != 0 ? magnitude : -magnitude);
    }
    const auto any = bytes.number<Sample>();
    return std::isfinite(any) ? any : Sample(byte);
  }
}

ScalarGrid grid_of(Bytes& bytes) {
  constexpr std::array<double, 12> kSpacings = {1, 1, 1, 1, 1, 0.2, 0.5, 2, 5, 0.1, 1e-3, 30};
  constexpr std::array<Vec3, 4> kOrigins = {Vec3{0, 0, 0}, Vec3{-3, 0.1, 1e3}, Vec3{1e6, -1e6, 0}, Vec3{0, 0, 0}};
  constexpr int kMostSamples = 48;
  const auto type = static_cast<SampleType>(bytes.next() % 7);
  const unsigned kind = bytes.next();
  Dims dims{};
  for (std::int32_t& n : dims) n = 2 + bytes.next() % 5;
  while (dims[0] * dims[1] * dims[2] > kMostSamples) --*std::max_element(dims.begin(), dims.end());
  Vec3 spacing{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis)
    spacing[static_cast<std::size_t>(axis)] = kSpacings[bytes.next() % kSpacings.size()];
  const Vec3 origin = kOrigins[bytes.next() % kOrigins.size()];
  const int count = dims[0] * dims[1] * dims[2];
  Samples samples = visit_samples(empty_samples(type), [&]<class Sample>(const SampleArray<Sample>&) -> Samples {
    std::vector<Sample> made;
    for (int n = 0; n < count; ++n) made.push_back(sample_of<Sample>(bytes, kind));
    return SampleArray<Sample>(std::move(made));
  });
  return {dims, std::move(samples), spacing, origin};
}

// A part of the range, one of the samples, or outside.
double isovalue_of(unsigned kind, unsigned place, const ScalarGrid& grid) {
  const auto [low, high] = grid.range();
  if (kind % 8 == 7) return high + place;
  if (kind % 8 < 4) return low + (high - low) * ((place + 0.5) / 256);
  const auto sample = static_cast<std::int32_t>(place);
  return grid.at(sample % grid.dims()[0], sample / 6 % grid.dims()[1], sample / 36 % grid.dims()[2]);
}

MeshingOptions options_of(Bytes& bytes) {
  constexpr std::int64_t kMostVertices = 600;
  MeshingOptions options;
  const unsigned bits = bytes.next();
  options.parameters.boundary = (bits & 1u) != 0 ? Boundary::kClosed : Boundary::kOpen;
  options.threads = (bits & 6u) == 6u ? 2 : 1;
  if ((bits & 0x38u) == 0x38u) options.parameters.algorithm = Algorithm::kFull3d;
  options.parameters.budget.max_vertices = kMostVertices;
  options.seed = 1 + (bits >> 6u);
  return options;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

struct MeshingCase {
  ScalarGrid grid;
  double isovalue = 0;
  MeshingOptions options;
};

MeshingCase case_of(Bytes bytes) {
  MeshingOptions options = options_of(bytes);
  const unsigned kind = bytes.next(), place = bytes.next();
  ScalarGrid grid = grid_of(bytes);
  const double isovalue = isovalue_of(kind, place, grid);
  return {std::move(grid), isovalue, std::move(options)};
}

void keep(const MeshingCase& c) {
  const char* const file = std::getenv("DELISO_FUZZ_KEEP");
  if (file == nullptr) return;
  write_volume(c.grid, file, NrrdEncoding::kRaw);
  const Parameters& p = c.options.parameters;
  std::fprintf(stderr, "deliso mesh %s --isovalue %s -o m.ply --seed %d --threads %d%s%s\n", file,
               shortest_text(c.isovalue).c_str(), static_cast<int>(c.options.seed), c.options.threads,
               p.boundary == Boundary::kClosed ? " --set boundary=closed" : "",
               p.algorithm == Algorithm::kFull3d ? " --set algorithm=full3d" : "");
}

void judge(const MeshingCase& c, const MeshingResult& result) {
  if (result.stopped_early()) {
    require(certify(result.mesh, std::vector<ComponentTopology>()).manifold, "a partial mesh is manifold");
    return;
  }
  if (!is_proven(result.certificate)) return;
  const bool is_closed = c.options.parameters.boundary == Boundary::kClosed;
  const MeshedField field = meshed_field(c.grid, c.isovalue, {}, is_closed, c.grid.spacing(), 1);
  const Promise promise{.max_distance = c.options.parameters.promise.max_distance};
  const Verification v = verify_mesh(result.mesh, field.grid, field.isovalue, promise);
  const char* const kWhat = "what the mesher proves, the verifier proves";
  if (!v.proven && std::getenv("DELISO_FUZZ_NOTE") != nullptr) {
    std::fprintf(stderr, "noted: not so: %s\n%s", kWhat, joined(v.failures).c_str());
    return;
  }
  require(v.proven, kWhat, joined(v.failures));
}

void run(std::span<const std::uint8_t> input) {
  try {
    const MeshingCase c = case_of(Bytes(input));
    keep(c);
    judge(c, mesh_isosurface(c.grid, c.isovalue, c.options));
  } catch (const InputError& error) {
    require_sentence(error.what());
  }
}

}  // namespace
}  // namespace deliso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deliso::fuzz::run({data, size});
  return 0;
}
