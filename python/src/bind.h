// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

/// Declarations that the parts of the Python module share.
namespace dismantle::python {

namespace py = pybind11;

/// Contiguous float64, as given where it is so already.
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

// The parts of the module, in the order in which they need each other.
void bind_errors(py::module_& module);
void bind_assembly(py::module_& module);
void bind_engine(py::module_& module);
void bind_session(py::module_& module);
void bind_plan(py::module_& module);

/// The pair states of an assembly; input of everything that moves components.
struct CheckedAssembly {
  std::shared_ptr<Assembly> assembly;
  PairStates pairs;
};
using CheckedHolder = std::shared_ptr<CheckedAssembly>;

/// An Error on its way to Python, where it becomes an exception with the same sentence.
struct ErrorException {
  Error error;
};
[[noreturn]] void raise(const Error& error);
[[noreturn]] void raise_usage(const std::string& message);

template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}
inline void value_or_raise(const Result<Done>& result) {
  if (!result) raise(result.error());
}

/// Lets a Python function see how long work is going and call it off (by returning False), and Ctrl+C end it. What
/// either raises is raised again by finish().
class PythonProgress {
 public:
  explicit PythonProgress(py::object function) : function_(std::move(function)) {}
  ProgressCallback callback();
  /// After the work, with the GIL.
  void finish();

 private:
  bool ask(std::string_view stage, double fraction);

  py::object function_;
  std::mutex mutex_;
  std::unique_ptr<py::error_already_set> raised_;
};

/// Runs work without the GIL.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// As many threads as there are cores where it is 0.
Executor executor_of(int threads);

/// The component that a name or an index is of.
ComponentId component_of(const Assembly& assembly, const py::handle& key);
/// One name or index, or a sequence of them; none where it is None.
std::vector<ComponentId> components_of(const Assembly& assembly, const py::handle& keys);
/// The names in order.
std::vector<std::string> component_names(const Assembly& assembly, Span<const ComponentId> components);

/// Poses as an array has them: rows of x, y, z [mm], w, x, y, z. The array's own memory where the quaternions are unit
/// to rounding, else a copy with them scaled to 1. Raises UsageError for another shape, for numbers that are not finite
/// and quaternions far off unit length.
class Poses {
 public:
  explicit Poses(const DoubleArray& array);
  Span<const Pose> span() const { return span_; }

 private:
  DoubleArray array_;
  std::vector<Pose> scaled_;
  Span<const Pose> span_;
};
/// One row. Raises as Poses.
Pose pose_of(const DoubleArray& array);
/// Three finite numbers.
Vec3 vector_of(const DoubleArray& array);

py::array_t<double> to_array(const Pose& pose);
py::array_t<double> to_array(const Vec3& v);
/// Rows of seven.
py::array_t<double> to_array(Span<const Pose> poses);

/// Moves a vector to where arrays can look at it.
template <class T>
std::pair<py::capsule, const T*> keep(std::vector<T> values) {
  auto* kept = new std::vector<T>(std::move(values));
  return {py::capsule(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); }), kept->data()};
}

/// An array that looks at `count` values of a member of kept records, without a copy; with more than one column, at
/// `columns` scalars in a row. Read-only.
template <class Scalar, class Record>
py::array_t<Scalar> look_at(const Scalar* first, std::size_t count, const py::object& owner, std::size_t columns = 0) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)}, strides{sizeof(Record)};
  if (columns > 0) {
    shape.push_back(static_cast<py::ssize_t>(columns));
    strides.push_back(sizeof(Scalar));
  }
  py::array_t<Scalar> array(shape, strides, first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An object that one thread uses at a time, whatever Python's threads do.
class Turn {
 public:
  /// Raises UsageError where another thread has it.
  Turn(std::mutex& mutex, const char* what);

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace dismantle::python
