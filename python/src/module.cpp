// SPDX-License-Identifier: Apache-2.0
#include "python/src/bind.h"

#include <algorithm>
#include <cmath>

namespace dismantle::python {

namespace {

constexpr double kUnitQuaternionTolerance = 1e-6;  // the same as for files
constexpr double kRounding = 1e-15;

/// The exception classes; created once, never released.
PyObject* g_error = nullptr;
PyObject* g_usage_error = nullptr;
PyObject* g_unreadable_error = nullptr;
PyObject* g_failed_error = nullptr;

PyObject* type_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return g_usage_error;
    case ErrorKind::Unreadable:
      return g_unreadable_error;
    case ErrorKind::Failed:
      break;
  }
  return g_failed_error;
}

PyObject* new_error(py::module_& module, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full_name = "dismantle." + std::string(name);
  PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.add_object(name, py::reinterpret_borrow<py::object>(type));
  return type;
}

const char* const kPoseShape =
    "a pose cannot be read (it is not seven numbers); give x, y, z, and a quaternion w, x, y, z";

/// Deviation of the quaternion's squared length from 1. Raises if a number is not finite.
double quaternion_fault(const Pose& pose) {
  const double fault = std::fabs(dot(pose.rotation, pose.rotation) - 1);
  if (!is_finite(pose.position) || !(fault <= 2 * kUnitQuaternionTolerance))
    raise_usage("a pose cannot be used (it is not finite, or its quaternion is not of unit length); correct it");
  return fault;
}

}  // namespace

void raise(const Error& error) {
  throw ErrorException{error};
}

void raise_usage(const std::string& message) {
  raise({ErrorKind::Usage, message});
}

void bind_errors(py::module_& module) {
  const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
  g_error =
      new_error(module, "Error",
                "Base class of the errors of dismantle. The message says what the problem is, why, and what to do.",
                py::make_tuple(builtin(PyExc_Exception)));
  const py::object base = py::reinterpret_borrow<py::object>(g_error);
  g_usage_error = new_error(module, "UsageError", "An argument is invalid, or the call is not possible now.",
                            py::make_tuple(base, builtin(PyExc_ValueError)));
  g_unreadable_error = new_error(module, "UnreadableError", "An input file cannot be read, or is malformed.",
                                 py::make_tuple(base, builtin(PyExc_OSError)));
  g_failed_error = new_error(module, "FailedError", "The work failed: disk full, out of memory, cancelled.",
                             py::make_tuple(base, builtin(PyExc_RuntimeError)));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const ErrorException& e) {
      PyErr_SetString(type_of(e.error.kind), e.error.message.c_str());
    }
  });
}

ProgressCallback PythonProgress::callback() {
  return [this](std::string_view stage, double fraction) { return report(stage, fraction); };
}

bool PythonProgress::report(std::string_view stage, double fraction) {
  const py::gil_scoped_acquire gil;
  if (raised_) return false;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (function_.is_none()) return true;
    const py::object result = function_(std::string(stage), fraction);
    return result.is_none() || result.cast<bool>();
  } catch (py::error_already_set& e) {
    raised_ = std::make_unique<py::error_already_set>(std::move(e));
    return false;
  }
}

void PythonProgress::finish() {
  if (!raised_) return;
  py::error_already_set raised(std::move(*raised_));
  raised_.reset();
  throw raised;  // NOLINT: moved out, so that it is thrown once
}

Executor executor_of(int threads) {
  if (threads < 0) raise_usage("the number of threads cannot be used (it is negative); give 0 for all cores");
  return Executor(threads == 1 ? ExecutorKind::Serial : ExecutorKind::Threads, threads);
}

ComponentId component_of(const Assembly& assembly, const py::handle& key) {
  if (py::isinstance<py::str>(key)) {
    const auto name = key.cast<std::string>();
    if (const std::optional<ComponentId> id = assembly.find(name)) return *id;
    raise_usage("'" + name + "' is unknown (the assembly has no component of that name); see Assembly.names");
  }
  const py::object number = py::reinterpret_steal<py::object>(PyNumber_Index(key.ptr()));
  if (!number) throw py::error_already_set();
  const auto index = number.cast<long long>();
  if (index < 0 || static_cast<std::size_t>(index) >= assembly.components.size())
    raise_usage("there is no component " + std::to_string(index) + " (the assembly has " +
                std::to_string(assembly.components.size()) + "); give one that it has");
  return ComponentId(static_cast<std::uint32_t>(index));
}

std::vector<ComponentId> components_of(const Assembly& assembly, const py::handle& keys) {
  if (keys.is_none()) return {};
  if (py::isinstance<py::str>(keys) || PyIndex_Check(keys.ptr())) return {component_of(assembly, keys)};
  std::vector<ComponentId> components;
  for (const py::handle& key : py::reinterpret_borrow<py::iterable>(keys)) {
    const ComponentId component = component_of(assembly, key);
    if (std::find(components.begin(), components.end(), component) == components.end()) components.push_back(component);
  }
  return components;
}

std::vector<std::string> component_names(const Assembly& assembly, Span<const ComponentId> components) {
  std::vector<std::string> names;
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  return names;
}

Poses::Poses(const DoubleArray& array) : array_(array) {
  static_assert(sizeof(Pose) == 7 * sizeof(double), "a row of an array is a pose");
  if (array.size() == 0) return;
  if (array.shape(array.ndim() - 1) != 7 || array.ndim() > 2) raise_usage(kPoseShape);
  const auto count = static_cast<std::size_t>(array.size() / 7);
  span_ = {reinterpret_cast<const Pose*>(array.data()), count};
  double fault = 0;
  for (const Pose& pose : span_) fault = std::max(fault, quaternion_fault(pose));
  if (fault <= kRounding) return;
  scaled_.assign(span_.begin(), span_.end());
  for (Pose& pose : scaled_) pose.rotation = normalized(pose.rotation);
  span_ = scaled_;
}

Pose pose_of(const DoubleArray& array) {
  if (array.size() != 7) raise_usage(kPoseShape);
  return Poses(array).span()[0];
}

Vec3 vector_of(const DoubleArray& array) {
  if (array.size() != 3) raise_usage("a vector cannot be read (it is not three numbers); give x, y, z");
  const Vec3 v{array.data()[0], array.data()[1], array.data()[2]};
  if (!is_finite(v)) raise_usage("a vector cannot be used (it is not finite); correct it");
  return v;
}

py::array_t<double> to_array(const Pose& pose) {
  return py::array_t<double>(7, reinterpret_cast<const double*>(&pose));
}

py::array_t<double> to_array(const Vec3& v) {
  return py::array_t<double>(3, &v.x);
}

py::array_t<double> to_array(Span<const Pose> poses) {
  return py::array_t<double>({static_cast<py::ssize_t>(poses.size()), py::ssize_t{7}},
                             reinterpret_cast<const double*>(poses.data()));
}

ExclusiveUse::ExclusiveUse(std::mutex& mutex, const char* name) : lock_(mutex, std::try_to_lock) {
  if (!lock_) raise_usage("the " + std::string(name) + " is busy (another thread uses it); make one for each thread");
}

}  // namespace dismantle::python

PYBIND11_MODULE(_dismantle, module) {
  using namespace dismantle::python;
  module.doc() =
      "Virtual disassembly with continuous collision handling. Lengths are in mm, angles in rad, times in s.";
  module.attr("__version__") = DISMANTLE_VERSION;
  bind_errors(module);
  bind_assembly(module);
  bind_engine(module);
  bind_session(module);
  bind_plan(module);
}
