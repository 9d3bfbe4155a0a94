// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"
#include "dismantle/session/session.h"
#include "python/src/path_object.h"
#include "python/src/step_result.h"

#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace dismantle::python {

namespace {

constexpr double kAdvance = 0.02;  // of an automatic motion, in one step [s]

/// A session, used by one thread at a time.
class SessionObject {
 public:
  SessionObject(const CheckedHolder& states, int threads)
      : states_(states), session_(*states->assembly, states->pairs, engine_options(states, threads)) {}

  const Assembly& assembly() const { return *states_->assembly; }

  void hold(const py::object& components) {
    const ExclusiveUse use(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    value_or_raise(without_gil([&] { return session_.hold(set); }));
  }
  StepView drag(const DoubleArray& target, double time) {
    const ExclusiveUse use(mutex_, kName);
    if (session_.activity() != SessionActivity::Drag)
      raise_usage("nothing can be dragged (no component is held); call hold first");
    const Pose pose = pose_of(target);
    return {states_->assembly, without_gil([&] { return session_.drag(pose, time); })};
  }
  bool release() {
    const ExclusiveUse use(mutex_, kName);
    return session_.activity() == SessionActivity::Drag && session_.release();
  }
  void cancel_drag() {
    const ExclusiveUse use(mutex_, kName);
    if (session_.activity() == SessionActivity::Drag) without_gil([&] { session_.cancel_drag(); });
  }
  void undo() {
    const ExclusiveUse use(mutex_, kName);
    value_or_raise(without_gil([&] { return session_.undo(); }));
  }
  void redo() {
    const ExclusiveUse use(mutex_, kName);
    value_or_raise(without_gil([&] { return session_.redo(); }));
  }
  void reset() {
    const ExclusiveUse use(mutex_, kName);
    without_gil([&] { session_.reset(); });
  }

  bool take_out(const py::object& components, const py::object& direction) {
    const ExclusiveUse use(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    std::optional<Vec3> along;
    if (!direction.is_none()) along = vector_of(direction.cast<DoubleArray>());
    value_or_raise(without_gil([&] { return session_.take_out(set, along); }));
    finish_motion();
    return session_.is_removed(set[0]);
  }
  bool put_back(const py::object& components) {
    const ExclusiveUse use(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    value_or_raise(without_gil([&] { return session_.put_back(set); }));
    finish_motion();
    return session_.poses()[set[0].value] == Pose{};
  }
  std::vector<FreeDirection> free_directions(const py::object& components) {
    const ExclusiveUse use(mutex_, kName);
    const std::vector<ComponentId> set = named(components);
    return value_or_raise(without_gil([&] { return session_.free_directions(set); }));
  }

  py::array_t<double> poses() {
    const ExclusiveUse use(mutex_, kName);
    return to_array(session_.poses());
  }
  std::vector<std::string> removed() {
    const ExclusiveUse use(mutex_, kName);
    std::vector<ComponentId> away;
    for (std::uint32_t c = 0; c < assembly().components.size(); ++c)
      if (session_.is_removed(ComponentId(c))) away.push_back(ComponentId(c));
    return component_names(assembly(), away);
  }
  PathHolder recording() {
    const ExclusiveUse use(mutex_, kName);
    return shared_path(session_.recording());
  }
  std::string response() const { return std::string(name_of(session_.response())); }
  void set_response(const std::string& name) {
    const ExclusiveUse use(mutex_, kName);
    session_.set_response(response_of(name));
  }

 private:
  static constexpr const char* kName = "session";

  std::vector<ComponentId> named(const py::object& keys) const {
    std::vector<ComponentId> set = components_of(assembly(), keys);
    if (set.empty()) raise_usage("nothing can move (no component is named); name at least one");
    return set;
  }
  /// Carries out the automatic motion to its end. Ctrl+C stops it.
  void finish_motion() {
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
  py::class_<dismantle::Move>(module, "Move",
                              "A move of a path: components that move together as one rigid body through frames.")
      .def_readonly("label", &dismantle::Move::label, "Text for the user.")
      .def_readonly("components", &dismantle::Move::components, "Names of the components.")
      .def_property_readonly("times", &times_of, "Times of the frames [s], shape (n,).")
      .def_property_readonly("poses", &poses_of,
                             "Poses of the frames, with a screw motion from each to the next, shape (n, 7).");
  py::class_<Path, PathHolder>(module, "Path", "Moves that were carried out or planned: a file *.path.json.")
      .def_readonly("assembly_file", &Path::assembly_file, "Name of the assembly's file.")
      .def_readonly("components", &Path::components, "Names of the assembly's components.")
      .def_readonly("tolerance", &Path::tolerance,
                    "Penetration depth allowed for pairs without an allowance of their own [mm].")
      .def_readonly("moves", &Path::moves, "The moves in order.")
      .def_readonly("removed", &Path::removed, "Names of the components that are removed at the end.")
      .def(
          "write", [](const Path& path, const std::filesystem::path& file) { value_or_raise(write_path(file, path)); },
          py::arg("file"), "Writes a *.path.json file.")
      .def(
          "there_and_back", [](const Path& path) { return shared_path(there_and_back(path)); },
          "The path followed by its reverse, so that everything is assembled at the end.")
      .def(
          "__eq__", [](const Path& a, const Path& b) { return a == b; }, py::is_operator());
  module.def(
      "read_path", [](const std::filesystem::path& file) { return shared_path(value_or_raise(read_path(file))); },
      py::arg("file"), "Reads a *.path.json file.");
}

}  // namespace

void bind_session(py::module_& module) {
  bind_path(module);
  py::class_<FreeDirection>(module, "FreeDirection", "Straight travel of a set along a direction.")
      .def_property_readonly(
          "direction", [](const FreeDirection& d) { return to_array(d.direction); }, "Unit vector, shape (3,).")
      .def_readonly("free", &FreeDirection::free, "True if the set can be removed along the direction.")
      .def_readonly("distance", &FreeDirection::distance, "Free distance [mm].");
  py::class_<SessionObject>(module, "Session",
                            "An interactive session with a recording, undo and redo. One thread may use it at a time.")
      .def(py::init<CheckedHolder, int>(), py::arg("states"), py::kw_only(), py::arg("threads") = 1)
      .def_property("response", &SessionObject::response, &SessionObject::set_response,
                    "Response of drags to contact: 'stop', 'touch' or 'slide'.")
      .def("hold", &SessionObject::hold, py::arg("components"), "Starts to drag components, as one rigid body.")
      .def("drag", &SessionObject::drag, py::arg("target"), py::arg("time") = 0.0,
           "Moves the dragged set towards a target pose, shape (7,); `time` since the start of the drag [s].")
      .def("release", &SessionObject::release, "Ends the drag. Returns True if anything moved.")
      .def("cancel_drag", &SessionObject::cancel_drag, "Ends the drag and restores the poses before it.")
      .def("undo", &SessionObject::undo, "Undoes the last drag or automatic motion.")
      .def("redo", &SessionObject::redo, "Redoes the last undone one.")
      .def("reset", &SessionObject::reset, "Assembles everything and clears the recording.")
      .def("take_out", &SessionObject::take_out, py::arg("components"), py::arg("direction") = py::none(),
           "Moves components straight out along `direction`, shape (3,), by default along the shortest free one. "
           "Returns "
           "True if they were removed.")
      .def("put_back", &SessionObject::put_back, py::arg("components"),
           "Moves components back along their recorded path. Returns True if they are in assembled position again.")
      .def("free_directions", &SessionObject::free_directions, py::arg("components"),
           "The free distances along candidate directions, free ones first.")
      .def_property_readonly("poses", &SessionObject::poses, "Poses of all components, shape (n, 7).")
      .def_property_readonly("removed", &SessionObject::removed, "Names of the removed components.")
      .def_property_readonly("recording", &SessionObject::recording, "The moves so far, as a Path.");
}

}  // namespace dismantle::python
