// The functions of the library for Python; src/deliso/__init__.py gives them the arguments that people use.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "experiments/python/interruptible.h"

namespace deliso::python {
namespace {

using Rows = std::array<std::array<double, 4>, 3>;
using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Triangles = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

// Precondition: native byte order.
ScalarType scalar_type(const py::dtype& type) {
  const std::map<std::string, ScalarType> known = {
      {"u1", ScalarType::kUint8},   {"i1", ScalarType::kInt8},    {"u2", ScalarType::kUint16},
      {"i2", ScalarType::kInt16},   {"u4", ScalarType::kUint32},  {"i4", ScalarType::kInt32},
      {"u8", ScalarType::kUint64},  {"i8", ScalarType::kInt64},   {"f2", ScalarType::kFloat16},
      {"f4", ScalarType::kFloat32}, {"f8", ScalarType::kFloat64}, {"b1", ScalarType::kBool}};
  const auto found = known.find(std::string(1, type.kind()) + std::to_string(type.itemsize()));
  if (found != known.end()) return found->second;
  throw py::value_error("array: expected whole numbers, floats of at most 64 bits or bool, found the dtype " +
                        py::str(static_cast<const py::object&>(type)).cast<std::string>());
}

// The array's own memory: index 0 is x.
VolumeView view_of_array(const py::array& array, const Rows& affine) {
  if (array.ndim() != 3)
    throw py::value_error("array: expected three dimensions, found " + std::to_string(array.ndim()));
  VolumeView view;
  view.samples = array.data();
  view.type = scalar_type(array.dtype());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    view.dims[axis] = array.shape(static_cast<py::ssize_t>(axis));
    view.strides[axis] = array.strides(static_cast<py::ssize_t>(axis));
  }
  view.affine = affine;
  return view;
}

// A number too large for any parameter as its digits, which the parameter refuses.
ParameterInput whole_number(const py::handle& value) {
  int overflow = 0;
  const std::int64_t number = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
  if (overflow == 0) return number;
  return py::repr(value).cast<std::string>();
}

// Of values that are None or of the types bool, int, float and str.
ParameterSet parameter_set(const py::dict& named) {
  ParameterSet set;
  for (const auto& [name, value] : named) {
    const auto key = name.cast<std::string>();
    ParameterInput input;
    if (value.is_none()) {
      input = std::monostate();
    } else if (py::isinstance<py::bool_>(value)) {
      input = value.cast<bool>();
    } else if (py::isinstance<py::int_>(value)) {
      input = whole_number(value);
    } else if (py::isinstance<py::float_>(value)) {
      input = value.cast<double>();
    } else {
      input = value.cast<std::string>();
    }
    set.set(key, input);
  }
  return set;
}

template <class To, class From>
py::array_t<To> array_of_rows(const std::vector<std::array<From, 3>>& rows) {
  py::array_t<To> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  To* to = array.mutable_data();
  for (const auto& row : rows)
    to = std::transform(row.begin(), row.end(), to, [](From v) { return static_cast<To>(v); });
  return array;
}

void check_rows(const py::array& array, const std::string& name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  throw py::value_error(name + ": expected an array of the shape (n, 3), found " +
                        py::str(array.attr("shape")).cast<std::string>());
}

Mesh mesh_of(const Vertices& vertices, const Triangles& triangles) {
  check_rows(vertices, "vertices");
  check_rows(triangles, "triangles");
  Mesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(vertices.shape(0)));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    std::copy_n(vertices.data() + 3 * v, 3, mesh.vertices[v].begin());
  mesh.triangles.resize(static_cast<std::size_t>(triangles.shape(0)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int64_t vertex = triangles.data()[3 * t + corner];
      if (vertex < 0 || vertex >= vertices.shape(0)) {
        throw py::value_error("triangle " + std::to_string(t) + " names the vertex " + std::to_string(vertex) +
                              (vertices.shape(0) == 0 ? ", but there are none" : ", expected 0 to ") +
                              (vertices.shape(0) == 0 ? std::string() : std::to_string(vertices.shape(0) - 1)));
      }
      mesh.triangles[t][corner] = static_cast<std::uint32_t>(vertex);
    }
  }
  return mesh;
}

// For a Ctrl-C that came too late to stop anything, or where there is no partial result.
[[noreturn]] void raise_interrupt() {
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

py::tuple mesh_array(const py::array& array, double isovalue, const Rows& affine, const py::dict& parameters,
                     std::uint64_t seed, int threads, const py::object& progress) {
  const VolumeView view = view_of_array(array, affine);
  MeshOptions options;
  options.parameters = parameter_set(parameters);
  options.seed = seed;
  options.threads = threads;
  int interrupts = 0;
  const MeshResult result = run_interruptible<MeshResult>(
      [view, isovalue, options](const ProgressCallback& tell, std::atomic<bool>& stop) {
        MeshOptions watched = options;
        watched.progress = tell;
        watched.stop = &stop;
        return mesh(view, isovalue, watched);
      },
      progress, array, interrupts);
  if (interrupts > 0 && !result.report.stopped) raise_interrupt();
  return py::make_tuple(array_of_rows<double>(result.mesh.vertices), array_of_rows<std::int32_t>(result.mesh.triangles),
                        result.report.json);
}

// Work without a partial result.
template <class Report, class Call>
std::string report_of(Call call, const py::object& progress, const py::object& kept) {
  int interrupts = 0;
  try {
    const Report report = run_interruptible<Report>(
        [call = std::move(call)](const ProgressCallback& tell, std::atomic<bool>& /*stop*/) { return call(tell); },
        progress, kept, interrupts);
    if (interrupts == 0) return report.json;
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::kStopped || interrupts == 0) throw;
  }
  raise_interrupt();
}

std::string verify_array(const Vertices& vertices, const Triangles& triangles, const py::array& array, double isovalue,
                         const Rows& affine, const py::dict& parameters, double max_distance,
                         std::int64_t dropped_components, int threads, const py::object& progress) {
  const VolumeView view = view_of_array(array, affine);
  Mesh mesh = mesh_of(vertices, triangles);
  VerifyOptions options;
  options.parameters = parameter_set(parameters);
  options.max_distance = max_distance;
  options.dropped_components = dropped_components;
  options.threads = threads;
  return report_of<VerifyReport>(
      [view, isovalue, options, mesh = std::move(mesh)](const ProgressCallback& tell) {
        VerifyOptions watched = options;
        watched.progress = tell;
        return verify(mesh, view, isovalue, watched);
      },
      progress, array);
}

std::string topology_of_array(const py::array& array, double isovalue, const Rows& affine, const py::dict& parameters,
                              int threads, const py::object& progress) {
  const VolumeView view = view_of_array(array, affine);
  TopologyOptions options;
  options.parameters = parameter_set(parameters);
  options.threads = threads;
  return report_of<TopologyReport>(
      [view, isovalue, options](const ProgressCallback& tell) {
        TopologyOptions watched = options;
        watched.progress = tell;
        return topology(view, isovalue, watched);
      },
      progress, array);
}

double isovalue_of_name(const py::array& array, const std::string& name, const py::dict& parameters) {
  const VolumeView view = view_of_array(array, VolumeView().affine);
  const ParameterSet set = parameter_set(parameters);
  const py::gil_scoped_release unlocked;
  return named_isovalue(view, name, set);
}

std::string info_of_array(const py::array& array) {
  const VolumeView view = view_of_array(array, VolumeView().affine);
  const py::gil_scoped_release unlocked;
  return info(view).json;
}

// Text of a file or of an error, which may name one: bytes that are no UTF-8 become \xNN.
py::str text_of(const std::string& bytes) {
  PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "backslashreplace");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

// The file's samples, which the array keeps, and the rows of the affine map. Paths are bytes, as the system has them.
py::tuple read_volume_file(const py::bytes& name_of_file, std::optional<std::uint64_t> channel,
                           const std::string& name) {
  const std::string path = name_of_file;
  const LoadedVolume volume = [&] {
    const py::gil_scoped_release unlocked;
    return load_volume(path, channel, name);
  }();
  const std::map<ScalarType, const char*> names = {
      {ScalarType::kUint8, "u1"}, {ScalarType::kInt8, "i1"},    {ScalarType::kUint16, "u2"}, {ScalarType::kInt16, "i2"},
      {ScalarType::kInt32, "i4"}, {ScalarType::kFloat32, "f4"}, {ScalarType::kFloat64, "f8"}};
  const py::dtype type(names.at(volume.view.type));
  const auto& [nx, ny, nz] = volume.view.dims;
  const py::ssize_t size = type.itemsize();
  const auto memory = new std::shared_ptr<const void>(volume.memory);
  const py::capsule owner(memory, [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  // All 0 stands for packed samples.
  const auto& [sx, sy, sz] = volume.view.strides;
  const std::array<py::ssize_t, 3> packed = {size, size * nx, size * nx * ny};
  const std::array<py::ssize_t, 3> strides = sx == 0 ? packed : std::array<py::ssize_t, 3>{sx, sy, sz};
  py::array array(type, {nx, ny, nz}, {strides[0], strides[1], strides[2]}, volume.view.samples, owner);
  array.attr("flags").attr("writeable") = false;
  return py::make_tuple(array, volume.view.affine, text_of(volume.space), text_of(volume.units));
}

py::tuple read_mesh_file(const py::bytes& name) {
  const std::string path = name;
  const Mesh mesh = [&] {
    const py::gil_scoped_release unlocked;
    return load_mesh(path);
  }();
  return py::make_tuple(array_of_rows<double>(mesh.vertices), array_of_rows<std::int32_t>(mesh.triangles));
}

void write_mesh_file(const py::bytes& name, const Vertices& vertices, const Triangles& triangles,
                     const std::vector<std::string>& comments) {
  const std::string path = name;
  Mesh mesh = mesh_of(vertices, triangles);
  mesh.comments = comments;
  const py::gil_scoped_release unlocked;
  save_mesh(mesh, path);
}

py::list parameter_list() {
  py::list list;
  for (const ParameterInfo& parameter : parameters())
    list.append(
        py::make_tuple(parameter.name, parameter.default_value, parameter.allowed, parameter.unit, parameter.effect));
  return list;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    PyObject* const type = error.kind() == Error::Kind::kInput    ? PyExc_ValueError
                           : error.kind() == Error::Kind::kMemory ? PyExc_MemoryError
                                                                  : PyExc_RuntimeError;
    PyErr_SetObject(type, text_of(error.what()).ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_deliso, module) {
  py::register_exception_translator(&translate);
  module.attr("version") = version();
  module.def("mesh", &mesh_array);
  module.def("verify", &verify_array);
  module.def("topology", &topology_of_array);
  module.def("named_isovalue", &isovalue_of_name);
  module.def("info", &info_of_array);
  module.def("load_volume", &read_volume_file);
  module.def("load_mesh", &read_mesh_file);
  module.def("save_mesh", &write_mesh_file);
  module.def("parameters", &parameter_list);
}

}  // namespace deliso::python
