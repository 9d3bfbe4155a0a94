// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"
#include "dismantle/session/session.h"
#include "python/src/path_object.h"
#include "python/src/step_result.h"

#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace dismantle::python {

namespace {

constexpr double kAdvance = 0.02;  // [s] of a set that moves by itself, between two steps

/// A session, for one thread at a time.
class SessionObject {
 public:
  SessionObject(const CheckedHolder& states, int threads)
      : states_(states), session_(*states->assembly, states->pairs, {executor_of(threads), widest_lanes()}) {}

  const Assembly& assembly() const { return *states_->assembly; }

  void hold(const py::object& components) {
    const Turn turn(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    value_or_raise(without_gil([&] { return session_.hold(set); }));
  }
  StepView drag(const DoubleArray& target, double time) {
    const Turn turn(mutex_, kName);
    if (session_.activity() != SessionActivity::Drag)
      raise_usage("nothing can be dragged (no component is held); call hold first");
    const Pose pose = pose_of(target);
    return {states_->assembly, without_gil([&] { return session_.drag(pose, time); })};
  }
  bool release() {
    const Turn turn(mutex_, kName);
    return session_.activity() == SessionActivity::Drag && session_.release();
  }
  void cancel_drag() {
    const Turn turn(mutex_, kName);
    if (session_.activity() == SessionActivity::Drag) without_gil([&] { session_.cancel_drag(); });
  }
  void undo() {
    const Turn turn(mutex_, kName);
    value_or_raise(without_gil([&] { return session_.undo(); }));
  }
  void redo() {
    const Turn turn(mutex_, kName);
    value_or_raise(without_gil([&] { return session_.redo(); }));
  }
  void reset() {
    const Turn turn(mutex_, kName);
    without_gil([&] { session_.reset(); });
  }

  bool take_out(const py::object& components, const py::object& direction) {
    const Turn turn(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    std::optional<Vec3> along;
    if (!direction.is_none()) along = vector_of(direction.cast<DoubleArray>());
    value_or_raise(without_gil([&] { return session_.take_out(set, along); }));
    go_on();
    return session_.is_removed(set[0]);
  }
  bool put_back(const py::object& components) {
    const Turn turn(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    value_or_raise(without_gil([&] { return session_.put_back(set); }));
    go_on();
    return session_.poses()[set[0].value] == Pose{};
  }
  std::vector<FreeDirection> free_directions(const py::object& components) {
    const Turn turn(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    return value_or_raise(without_gil([&] { return session_.free_directions(set); }));
  }

  py::array_t<double> poses() {
    const Turn turn(mutex_, kName);
    return to_array(session_.poses());
  }
  std::vector<std::string> removed() {
    const Turn turn(mutex_, kName);
    std::vector<ComponentId> away;
    for (std::uint32_t c = 0; c < assembly().components.size(); ++c)
      if (session_.is_removed(ComponentId(c))) away.push_back(ComponentId(c));
    return component_names(assembly(), away);
  }
  PathHolder recording() {
    const Turn turn(mutex_, kName);
    return hold_path(session_.recording());
  }
  std::string response() const { return std::string(name_of(session_.response())); }
  void set_response(const std::string& name) {
    const Turn turn(mutex_, kName);
    session_.set_response(response_of(name));
  }

 private:
  static constexpr const char* kName = "session";

  std::vector<ComponentId> named(const py::object& keys) const {
    std::vector<ComponentId> set = components_of(assembly(), keys);
    if (set.empty()) raise_usage("nothing can move (no component is named); name at least one");
    return set;
  }
  /// Until nothing moves by itself any more. Ctrl+C halts it where it is.
  void go_on() {
    PythonProgress watched{py::none()};
    const ProgressCallback progress = watched.callback();
    without_gil([&] {
      while (session_.activity() == SessionActivity::Automatic) {
        session_.advance(kAdvance);
        if (!progress("", -1)) session_.halt();
      }
    });
    watched.finish();
  }

  CheckedHolder states_;
  Session session_;
  std::mutex mutex_;
};

py::array_t<double> times_of(const dismantle::Move& move) {
  py::array_t<double> array(static_cast<py::ssize_t>(move.frames.size()));
  for (std::size_t i = 0; i < move.frames.size(); ++i) array.mutable_data()[i] = move.frames[i].time;
  return array;
}

py::array_t<double> poses_of(const dismantle::Move& move) {
  std::vector<Pose> poses;
  for (const Frame& frame : move.frames) poses.push_back(frame.pose);
  return to_array(Span<const Pose>(poses));
}

void bind_path(py::module_& module) {
  py::class_<dismantle::Move>(module, "Move", "Components that go rigidly together through frames.")
      .def_readonly("label", &dismantle::Move::label)
      .def_readonly("components", &dismantle::Move::components)
      .def_property_readonly("times", &times_of, "[s], shape (n,).")
      .def_property_readonly("poses", &poses_of, "Shape (n, 7); a screw from each to the next.");
  py::class_<Path, PathHolder>(module, "Path", "What a session records and a plan gives: *.path.json.")
      .def_readonly("assembly_file", &Path::assembly_file)
      .def_readonly("components", &Path::components)
      .def_readonly("tolerance", &Path::tolerance, "[mm]")
      .def_readonly("moves", &Path::moves)
      .def_readonly("removed", &Path::removed)
      .def(
          "write", [](const Path& path, const std::filesystem::path& file) { value_or_raise(write_path(file, path)); },
          py::arg("file"))
      .def(
          "there_and_back", [](const Path& path) { return hold_path(there_and_back(path)); },
          "With its way back, so that all is assembled in the end.")
      .def(
          "__eq__", [](const Path& a, const Path& b) { return a == b; }, py::is_operator());
  module.def(
      "read_path", [](const std::filesystem::path& file) { return hold_path(value_or_raise(read_path(file))); },
      py::arg("file"));
}

}  // namespace

void bind_session(py::module_& module) {
  bind_path(module);
  py::class_<FreeDirection>(module, "FreeDirection", "How far a set can go straight.")
      .def_property_readonly("direction", [](const FreeDirection& d) { return to_array(d.direction); })
      .def_readonly("free", &FreeDirection::free)
      .def_readonly("distance", &FreeDirection::distance, "[mm]");
  py::class_<SessionObject>(module, "Session", "An assembly that is taken apart, with a recording, undo and redo.")
      .def(py::init<CheckedHolder, int>(), py::arg("states"), py::kw_only(), py::arg("threads") = 1)
      .def_property("response", &SessionObject::response, &SessionObject::set_response)
      .def("hold", &SessionObject::hold, py::arg("components"))
      .def("drag", &SessionObject::drag, py::arg("target"), py::arg("time") = 0.0)
      .def("release", &SessionObject::release)
      .def("cancel_drag", &SessionObject::cancel_drag)
      .def("undo", &SessionObject::undo)
      .def("redo", &SessionObject::redo)
      .def("reset", &SessionObject::reset)
      .def("take_out", &SessionObject::take_out, py::arg("components"), py::arg("direction") = py::none(),
           "Takes a set out straight; whether it got there.")
      .def("put_back", &SessionObject::put_back, py::arg("components"), "Whether it is home again.")
      .def("free_directions", &SessionObject::free_directions, py::arg("components"))
      .def_property_readonly("poses", &SessionObject::poses, "Of all components, shape (n, 7).")
      .def_property_readonly("removed", &SessionObject::removed)
      .def_property_readonly("recording", &SessionObject::recording);
}

}  // namespace dismantle::python
