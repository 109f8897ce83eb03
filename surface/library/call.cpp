#include "surface/library/call.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <type_traits>
#include <variant>

#include "delaunay/base/shortest_text.h"
#include "surface/base/parameter_value.h"
#include "surface/base/progress_share.h"
#include "surface/library/json_tree.h"
#include "surface/mesh/mesh_topology.h"
#include "volume/filters/labels.h"

namespace deliso {
namespace {

const std::string kSource = "parameters";

// A value as a message or a table shows it.
template <class Value>
std::string value_text(const Value& value) {
  return std::visit(
      [](const auto& held) {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::monostate>) {
          return JsonTree().text();
        } else if constexpr (std::is_same_v<Held, double>) {
          return std::isfinite(held) ? JsonTree(held).text() : shortest_text(held);  // JSON has no such numbers
        } else {
          return JsonTree(held).text();
        }
      },
      value);
}

ParameterValue plain_value_of(const ParameterInput& input) {
  return std::visit([](const auto& held) -> ParameterValue { return held; }, input);
}

void apply(const std::string& name, const ParameterInput& value, Parameters& parameters) {
  check_parameter_path(name, kSource);
  assign_parameter(*find_parameter(name), plain_value_of(value), value_text(value), kSource, parameters);
}

}  // namespace

std::string version() { return DELISO_VERSION_TEXT; }

Error::Error(Kind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}
Error::~Error() = default;

void ParameterSet::set_value(std::string_view name, ParameterInput value) {
  std::string key(name);
  call_guarded([&] {
    Parameters scratch;
    apply(key, value, scratch);
  });
  values_.emplace_back(std::move(key), std::move(value));
}

std::vector<ParameterInfo> parameters() {
  return call_guarded([] {
    std::vector<ParameterInfo> all;
    for (const ParameterField& field : parameter_table()) {
      all.push_back({std::string(field.path), value_text(field.get(Parameters())), allowed_values(field),
                     field.unit == "-" ? "" : std::string(field.unit), std::string(field.effect)});
    }
    return all;
  });
}

Parameters engine_parameters(const ParameterSet& set) {
  Parameters parameters;
  for (const auto& [name, value] : set.values()) apply(name, value, parameters);
  check_parameters(parameters);
  return parameters;
}

double isovalue_of_field(const Parameters& parameters, double asked) {
  if (!parameters.field.label) return asked;
  if (std::isnan(asked) || asked == kLabelIsovalue) return kLabelIsovalue;
  throw InputError("isovalue: the surface of a label lies half-way between it and all others, found " +
                   shortest_text(asked) + " beside field.label, expected " + shortest_text(kLabelIsovalue));
}

const std::filesystem::path& checked_path(const std::filesystem::path& path) {
  const std::string& name = path.native();
  const std::size_t zero = name.find('\0');
  if (zero == std::string::npos) return path;
  throw InputError("path: expected a file name, found '" + name.substr(0, zero) + "' followed by a null character");
}

void VolumeView::refuse_spacing(double length) {
  throw Error(Error::Kind::kInput, "spacing: expected three lengths > 0, found " + shortest_text(length) +
                                       "; an affine map may turn axes the other way round");
}

int thread_count(int asked) {
  if (asked < 0) throw InputError("threads: expected a number >= 0, found " + std::to_string(asked));
  constexpr int kMost = 1024;  // so that multiples of it are numbers; more would have nothing to do
  return asked > 0 ? std::min(asked, kMost) : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void Watcher::show(const Progress& progress) {
  tell({progress.stage, share_of_run(progress), share_of_stage(progress), progress.vertices});
}

void Watcher::show(double fraction, std::string_view step) { tell({step, fraction, 0, 0}); }

void Watcher::tell(const StageProgress& progress) {
  if (!callback_ || stop_->load()) return;
  fraction_ = std::clamp(progress.fraction, fraction_, 1.0);
  StageProgress told = progress;
  told.fraction = fraction_;
  try {
    if (!callback_(told)) stop_->store(true);
  } catch (...) {
    thrown_ = std::current_exception();
    stop_->store(true);
  }
}

TriangleMesh engine_mesh(const Mesh& mesh) {
  TriangleMesh own;
  own.points.reserve(mesh.vertices.size());
  for (const auto& [x, y, z] : mesh.vertices) {
    own.points.push_back({x, y, z});
    if (is_finite(own.points.back())) continue;
    throw InputError("vertex " + std::to_string(own.points.size() - 1) + " of the mesh is (" + shortest_text(x) + ", " +
                     shortest_text(y) + ", " + shortest_text(z) + "), expected finite numbers");
  }
  own.triangles = mesh.triangles;
  check_triangles(own);
  return own;
}

Mesh public_mesh(const TriangleMesh& mesh) {
  Mesh given;
  given.vertices.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) given.vertices.push_back({p.x, p.y, p.z});
  given.triangles = mesh.triangles;
  return given;
}

}  // namespace deliso
