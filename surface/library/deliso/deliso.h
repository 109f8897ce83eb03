// DelIso: isosurfaces of volumes as Delaunay triangle meshes, each checked against the exact topology of its
// isosurface. (T. K. Dey, J. A. Levine: Delaunay Meshing of Isosurfaces, 2007.)
//
//   deliso::VolumeView volume = deliso::view_of(samples.data(), {64, 64, 64});
//   deliso::MeshResult result = deliso::mesh(volume, 0.5);
//   if (result.report.proven) use(result.mesh.vertices, result.mesh.triangles);
//
// This is the only header of the library. The isosurface is that of the trilinear interpolant of the samples.
//
// Threads: every function may be called from several threads at once; none changes what another sees. What a function
// gives depends on its arguments alone, whatever the number of threads and the caller's rounding mode: the same bytes
// for the same compiled library.
//
// Errors: every failure is a deliso::Error, but for exceptions of a caller's own callback, which come through as they
// are. Nothing is printed.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "deliso/version.h"  // DELISO_VERSION_MAJOR, _MINOR, _PATCH, _TEXT and DELISO_VERSION

#define DELISO_API __attribute__((visibility("default")))

namespace deliso {

// The version of the library that runs, "0.2.0"; that of the header is DELISO_VERSION_TEXT.
DELISO_API std::string version();

// ---- Errors ----

// what() is one sentence: what was given, and what was expected.
class DELISO_API Error : public std::runtime_error {
 public:
  enum class Kind {
    kInput,    // something given is wrong: a volume, a mesh, a parameter, a file
    kStopped,  // the caller's callback returned false, and there is no partial result
    kMemory,   // not enough memory
    kBroken,   // an invariant of the library is broken: please report it
  };
  Error(Kind kind, const std::string& sentence);
  Error(const Error&) = default;
  Error& operator=(const Error&) = default;
  Error(Error&&) = default;
  Error& operator=(Error&&) = default;
  ~Error() override;
  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

// ---- Volumes ----

enum class ScalarType : std::uint8_t {
  kUint8,
  kInt8,
  kUint16,
  kInt16,
  kUint32,
  kInt32,
  kUint64,
  kInt64,
  kFloat16,  // IEEE 754 binary16
  kFloat32,
  kFloat64,
  kBool,  // a byte, 0 or 1
};

// Samples in the caller's memory, which must stay as it is while a function is working on it.
//
// No sample is copied where the three axes are packed without gaps, in any order and each forwards or backwards, the
// samples are aligned, and their type is not kUint32, kUint64, kInt64 or kFloat16 (these become int32 where all fit,
// else doubles, and floats). Else the samples are copied once. A region copies the samples of the region where they
// are not packed by themselves. `field.smooth`, `field.label` and `boundary` = closed make a new field.
// MeshReport::copied_samples tells.
//
// In which order the axes lie in memory decides which vertices are taken, not what is true of the mesh: a transposed
// copy of a volume gives another proven mesh of the same isosurface.
struct VolumeView {
  const void* samples = nullptr;  // sample (0, 0, 0)
  ScalarType type = ScalarType::kFloat32;
  std::array<std::int64_t, 3> dims{};     // samples along i, j, k; each at least 2
  std::array<std::int64_t, 3> strides{};  // bytes to the next sample along i, j, k; all 0: packed, i fastest
  // Sample (i, j, k) lies at affine * (i, j, k, 1); rows. Vertices are there, too.
  std::array<std::array<double, 4>, 3> affine{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  // Three lengths > 0; else an Error is thrown. For axes the other way round there is the affine map.
  void set_spacing(const std::array<double, 3>& spacing, const std::array<double, 3>& origin = {0, 0, 0}) {
    for (std::size_t row = 0; row < 3; ++row) {
      if (!(spacing[row] > 0)) refuse_spacing(spacing[row]);
      affine[row] = {0, 0, 0, origin[row]};
      affine[row][row] = spacing[row];
    }
  }
  [[noreturn]] DELISO_API static void refuse_spacing(double length);
};

template <class Sample>
constexpr ScalarType scalar_type_of() {
  if constexpr (std::is_same_v<Sample, bool>) {
    return ScalarType::kBool;
  } else if constexpr (std::is_floating_point_v<Sample>) {
    static_assert(sizeof(Sample) == 4 || sizeof(Sample) == 8, "samples are float or double");
    return sizeof(Sample) == 4 ? ScalarType::kFloat32 : ScalarType::kFloat64;
  } else {
    static_assert(std::is_integral_v<Sample>, "samples are numbers");
    constexpr int kPower = sizeof(Sample) == 1 ? 0 : sizeof(Sample) == 2 ? 1 : sizeof(Sample) == 4 ? 2 : 3;
    return static_cast<ScalarType>(2 * kPower + (std::is_signed_v<Sample> ? 1 : 0));
  }
}

// Packed samples, i fastest: sample (i, j, k) is samples[i + dims[0] * (j + dims[1] * k)].
template <class Sample>
VolumeView view_of(const Sample* samples, const std::array<std::int64_t, 3>& dims,
                   const std::array<double, 3>& spacing = {1, 1, 1}, const std::array<double, 3>& origin = {0, 0, 0}) {
  VolumeView view{samples, scalar_type_of<Sample>(), dims};
  view.set_spacing(spacing, origin);
  return view;
}

// A volume of a file, with its memory.
struct LoadedVolume {
  VolumeView view;  // valid as long as `memory`
  std::shared_ptr<const void> memory;
  std::string space;  // "left-posterior-superior", ...; empty where the file does not say
  std::string units;  // "mm", ...; likewise
};

// NRRD, NIfTI, MetaImage, VTK (.vtk, .vti), NumPy, MRC and CCP4, INR, PVM and .raw with dims and type in its name,
// packed by gzip or not. Where the file has several values a voxel, `channel` says which; of named arrays, `array`.
// Samples are counted as the file counts them: the strides are negative along axes that are kept the other way round.
DELISO_API LoadedVolume load_volume(const std::filesystem::path& path, std::optional<std::uint64_t> channel = {},
                                    const std::string& array = "");

struct VolumeInfo {
  double lowest = 0, highest = 0;  // of the finite samples
  std::uint64_t nan = 0, infinite = 0;
  std::string kind;                       // "field", "mask" (two whole numbers) or "labels" (few whole numbers)
  double otsu = 0, mean = 0, median = 0;  // isovalues, each in the middle of its gap between two sample values
  std::string json;                       // the same as text
};
DELISO_API VolumeInfo info(const VolumeView& volume);

// ---- Parameters ----

// monostate: null, no limit.
using ParameterInput = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

// Parameters by name, as in the table of `deliso schema`; what is not named has its default:
//   ParameterSet().set("size.max_error", 0.1).set("boundary", "closed").set("budget.seconds", nullptr)
class ParameterSet {
 public:
  // Throws Error when there is no such parameter (the sentence names the nearest), or the value is not allowed.
  template <class Value>
  ParameterSet& set(std::string_view name, const Value& value) {
    if constexpr (std::is_same_v<Value, std::nullptr_t>) {
      set_value(name, std::monostate());
    } else if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, ParameterInput>) {
      set_value(name, value);
    } else if constexpr (std::is_integral_v<Value>) {
      const auto number = static_cast<std::int64_t>(value);
      const bool is_too_large = std::is_unsigned_v<Value> && number < 0;
      set_value(name, is_too_large ? ParameterInput(static_cast<double>(value)) : ParameterInput(number));
    } else if constexpr (std::is_floating_point_v<Value>) {
      set_value(name, static_cast<double>(value));
    } else {
      if constexpr (std::is_pointer_v<Value>) {
        if (value == nullptr) return set(name, nullptr);
      }
      set_value(name, std::string(value));
    }
    return *this;
  }
  [[nodiscard]] const std::vector<std::pair<std::string, ParameterInput>>& values() const { return values_; }

 private:
  DELISO_API void set_value(std::string_view name, ParameterInput value);

  std::vector<std::pair<std::string, ParameterInput>> values_;
};

struct ParameterInfo {
  std::string name;           // "stage2.epsilon1"
  std::string default_value;  // as in JSON
  std::string allowed;        // "a number > 0"
  std::string unit;           // "voxels": of the smallest spacing
  std::string effect;
};
// All parameters, in their order.
DELISO_API std::vector<ParameterInfo> parameters();

// ---- Progress and stop ----

struct StageProgress {
  std::string_view stage;     // "index", "initial", "recover", "repair", "refine", "shape", "decimate", "certify"
  double fraction = 0;        // of the whole run, 0 to 1, an estimate that never goes back
  double stage_fraction = 0;  // of the stage, an estimate that may
  std::int64_t vertices = 0;  // so far
};
// Called now and then, in the thread that called the function. False: stop. mesh() then ends soon with a valid partial
// mesh; verify() and topology() throw Error::Kind::kStopped. What it throws comes out of the function.
using ProgressCallback = std::function<bool(const StageProgress&)>;

// ---- Meshes ----

// Triangles are counterclockwise seen from the side of lower values.
struct Mesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Lines for the file: what mesh() says of the field, the region and the promise, which `deliso verify` reads there.
  std::vector<std::string> comments{};
};

// By the extension: .ply, .off, .obj, .stl, .mesh, .msh, .smesh, .vtk, .vtp or .glb; all but .msh, .smesh and .glb are
// read. A file is written whole or not at all.
DELISO_API Mesh load_mesh(const std::filesystem::path& path);
DELISO_API void save_mesh(const Mesh& mesh, const std::filesystem::path& path);

// Equal components: connected, orientable surfaces, told apart by these two numbers.
struct ComponentCount {
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
  std::int64_t count = 0;
};

struct MeshOptions {
  ParameterSet parameters;
  std::uint64_t seed = 1;  // of the random choices
  int threads = 1;         // 0: as many as the machine has. The mesh is the same for any number.
  ProgressCallback progress;
  // May be set to true from any thread or from a signal's handler: the run then ends as if the callback had returned
  // false, which sets it, too. Null: there is none.
  std::atomic<bool>* stop = nullptr;
  bool keep_stage1 = false;  // also give the mesh that stage 2 begins with
};

// What is known of a run. Lengths in voxels: of the smallest spacing.
struct MeshReport {
  // All that a proven mesh promises holds: it is manifold, oriented, homeomorphic to the isosurface component by
  // component, no triangles cross or touch, vertices lie on the isosurface, distances both ways (of the isosurface at
  // least at its crossings with grid edges) are at most promised_distance.
  bool proven = false;
  bool stopped = false;    // by a budget or the callback: the mesh is valid and not finished
  std::string verdict;     // of the topology: "homeomorphic", "different", "singular_isovalue", "not_checked"
  std::string stopped_in;  // a stage; empty: not stopped
  std::vector<std::string> not_kept;     // what a proven mesh would keep and this one does not, a sentence each
  std::vector<std::string> differences;  // of its topology from the isosurface's, a sentence each
  std::vector<std::string> unmet;        // what a run that stopped has left undone; sizes that were not reached
  double isovalue_used = 0;              // differs from the isovalue only where a sample or a saddle has that value
  std::int64_t components = 0, euler_characteristic = 0, boundary_loops = 0;  // of the mesh
  std::int64_t dropped_components = 0;  // left out as asked (`components.*`); verify() wants to know their number
  double promised_distance = 0;         // of a run that was stopped: what would have been promised
  double min_angle_degrees = 0, max_angle_degrees = 0;  // before the shear of a map that has one
  bool copied_samples = false;                          // those of the caller, or a new field was made of them
  double seconds = 0;
  std::vector<std::pair<std::string, double>> stage_seconds;
  // With the keys of the program's --report, but for those of the file, the world, the field, the surface's measures
  // and memory; and with the mesh's comments.
  std::string json;
};

struct MeshResult {
  Mesh mesh;
  MeshReport report;
  std::optional<Mesh> stage1;
};

// Meshes the isosurface. Throws Error when something given is wrong: an isovalue outside the range of the samples, NaN
// among them, a dimension below 2. The surface of `field.label` has the isovalue 0.5, which NaN stands for, too.
DELISO_API MeshResult mesh(const VolumeView& volume, double isovalue, const MeshOptions& options = {});

// ---- Second opinions ----

struct VerifyOptions {
  // Those that say what surface is meant count: `field.*`, `region.*`, `boundary`, `spacing`; and the distance allowed,
  // `promise.max_distance` or `size.max_error`. The parameters of mesh() may be given as they are.
  ParameterSet parameters;
  double max_distance = 0;              // in voxels; 0: what the parameters say, or 1
  std::int64_t dropped_components = 0;  // so many are left out on purpose
  int threads = 1;                      // for `field.smooth` and `boundary`; 0: as many as the machine has
  ProgressCallback progress;
};

struct VerifyReport {
  bool proven = false;
  std::vector<std::string> failures;  // a sentence for each condition that fails
  // Checks by name: "manifold", "orientation", "boundary", "topology", "self_intersection", "residual", "distance";
  // "normals" and "delaunay_balls" are told and do not count.
  std::vector<std::pair<std::string, bool>> checks;
  double isovalue_used = 0;
  std::vector<ComponentCount> mesh, isosurface;
  std::int64_t crossing_pairs = 0;
  double residual = 0;                                    // of the vertices, the largest, in voxels
  double mesh_to_isosurface = 0, isosurface_to_mesh = 0;  // the largest distances, in voxels
  double min_angle_degrees = 0, max_angle_degrees = 0;
  double seconds = 0;
  std::string json;  // every figure
};

// Judges any mesh, whoever made it, as an image of the isosurface. Its vertices are where the affine map of the volume
// puts them.
DELISO_API VerifyReport verify(const Mesh& mesh, const VolumeView& volume, double isovalue,
                               const VerifyOptions& options = {});

// The isovalue "otsu", "mean", "median" or "P%", the share of the way from the lowest sample to the highest, of the
// samples of `region.*` that are finite.
DELISO_API double named_isovalue(const VolumeView& volume, std::string_view name, const ParameterSet& parameters = {});

struct TopologyOptions {
  ParameterSet parameters;  // `field.*`, `region.*`, `boundary` and `spacing` count
  int threads = 1;
  ProgressCallback progress;
};

struct TopologyReport {
  double isovalue_used = 0;
  std::vector<ComponentCount> isosurface;
  std::int64_t components = 0, euler_characteristic = 0, boundary_loops = 0;
  bool is_singular = false;  // a saddle still has the isovalue: the surface is no manifold there
  std::string json;
};

// The exact topology of the isosurface, without a mesh.
DELISO_API TopologyReport topology(const VolumeView& volume, double isovalue, const TopologyOptions& options = {});

}  // namespace deliso
