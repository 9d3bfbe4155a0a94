// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/certificates/certificate_engine.h"
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

/// A contiguous float64 array; converted only if the argument is not one.
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

// The parts of the module, in the order in which they depend on each other.
/// Adds the exceptions.
void bind_errors(py::module_& module);
/// Adds Component, Assembly, Pair, PairStates, load() and check().
void bind_assembly(py::module_& module);
/// Adds Engine, MotionBatch and their results.
void bind_engine(py::module_& module);
/// Adds Move, Path, Session and read_path().
void bind_session(py::module_& module);
/// Adds Plan, Explanation, AuditReport, plan(), why(), audit() and export().
void bind_plan(py::module_& module);

/// An assembly with its pair states: the class PairStates.
struct CheckedAssembly {
  std::shared_ptr<Assembly> assembly;  ///< Never null.
  PairStates pairs;                    ///< Of the assembly: what the engine allows.
  Clashes clashes;                     ///< Of the assembly: what people see.
  /// Surfaces that its engines share; null until engine_options() prepares them.
  std::shared_ptr<const AssemblySurfaces> prepared = {};
  std::unique_ptr<std::mutex> preparing = std::make_unique<std::mutex>();  ///< Held while `prepared` is made.
};
/// Shared by the Python objects that use it.
using CheckedHolder = std::shared_ptr<CheckedAssembly>;

/// Options of an engine that uses the shared surfaces. The first call prepares them, with the GIL released.
CertificateOptions engine_options(const CheckedHolder& states, int threads);
/// The surfaces if they are prepared already, else null. For operations that can be cancelled while they prepare their
/// own.
std::shared_ptr<const AssemblySurfaces> prepared_already(const CheckedHolder& states);

/// Carries an Error to Python, where it becomes an exception with the same message.
struct ErrorException {
  Error error;  ///< The kind selects the exception's class.
};
/// Raises the exception of an error.
[[noreturn]] void raise(const Error& error);
/// Raises UsageError.
[[noreturn]] void raise_usage(const std::string& message);

/// The value of a result; raises its error.
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}
/// Raises the error of a result, if it has one.
inline void value_or_raise(const Result<Done>& result) {
  if (!result) raise(result.error());
}

/// Reports progress to a Python function, which can cancel the work by returning False, and cancels it at Ctrl+C.
/// Exceptions of the function, and KeyboardInterrupt, are raised by finish().
class PythonProgress {
 public:
  /// @param function called with the stage and the fraction done; may be None
  explicit PythonProgress(py::object function) : function_(std::move(function)) {}
  /// The callback for the work. Acquires the GIL; must not outlive this.
  ProgressCallback callback();
  /// Raises the exception that ended the work, if any. Call after the work, with the GIL.
  void finish();

 private:
  bool report(std::string_view stage, double fraction);

  py::object function_;
  std::mutex mutex_;
  std::unique_ptr<py::error_already_set> raised_;
};

/// Runs `work` with the GIL released.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// An executor with this many threads; 0: one for each core. Raises UsageError if negative.
Executor executor_of(int threads);

/// The component with a name or an index. Raises UsageError if there is none.
ComponentId component_of(const Assembly& assembly, const py::handle& key);
/// The components of one name or index, or of a sequence of them, each once; None: no components.
std::vector<ComponentId> components_of(const Assembly& assembly, const py::handle& keys);
/// The names of components, in their order.
std::vector<std::string> component_names(const Assembly& assembly, Span<const ComponentId> components);

/// The poses of an array of shape (n, 7) or (7,): x, y, z [mm], w, x, y, z. A view of the array if its quaternions are
/// normalized, otherwise a normalized copy.
class Poses {
 public:
  /// Raises UsageError if the shape is another one, a number is not finite, or the length of a quaternion differs from
  /// 1 by more than 1e-6.
  explicit Poses(const DoubleArray& array);
  /// The poses; valid as long as this.
  Span<const Pose> span() const { return span_; }

 private:
  DoubleArray array_;
  std::vector<Pose> scaled_;
  Span<const Pose> span_;
};
/// The pose of an array of seven numbers. Raises as Poses.
Pose pose_of(const DoubleArray& array);
/// The vector of an array of three numbers. Raises UsageError if it has another size or is not finite.
Vec3 vector_of(const DoubleArray& array);

/// A pose as an array of shape (7,).
py::array_t<double> to_array(const Pose& pose);
/// A vector as an array of shape (3,).
py::array_t<double> to_array(const Vec3& v);
/// Poses as an array of shape (n, 7).
py::array_t<double> to_array(Span<const Pose> poses);

/// Moves a vector to the heap. @return its owner, for arrays that view it, and its first element
template <class T>
std::pair<py::capsule, const T*> make_owner(std::vector<T> values) {
  auto* kept = new std::vector<T>(std::move(values));
  return {py::capsule(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); }), kept->data()};
}

/// A read-only array that views a member of `count` consecutive records, without a copy: shape (count,), or (count,
/// columns) for a member of several scalars.
/// @param first the member of the first record
/// @param owner keeps the records alive
template <class Scalar, class Record>
py::array_t<Scalar> array_view(const Scalar* first, std::size_t count, const py::object& owner,
                               std::size_t columns = 0) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)}, strides{sizeof(Record)};
  if (columns > 0) {
    shape.push_back(static_cast<py::ssize_t>(columns));
    strides.push_back(sizeof(Scalar));
  }
  py::array_t<Scalar> array(shape, strides, first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Exclusive use of an object by one thread, for the scope of a call.
class ExclusiveUse {
 public:
  /// Raises UsageError if another thread uses the object. @param name of the object, for the message
  ExclusiveUse(std::mutex& mutex, const char* name);

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace dismantle::python
