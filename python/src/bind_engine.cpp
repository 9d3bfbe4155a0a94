// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/certificates/certificate_engine.h"
#include "python/src/step_result.h"

#include <set>

namespace dismantle::python {

namespace {

/// The method `certificates`, for one thread at a time.
class Engine {
 public:
  Engine(const CheckedHolder& states, int threads)
      : states_(states),
        executor_(executor_of(threads)),
        engine_(*states->assembly, states->pairs, {executor_, widest_lanes()}) {}

  const Assembly& assembly() const { return *states_->assembly; }

  void hold(const py::object& keys) {
    const Turn turn(mutex_, kName);
    const std::vector<ComponentId> set = components_of(assembly(), keys);
    if (set.empty()) raise_usage("nothing can be grabbed (no component is named); name at least one");
    for (const ComponentId c : set)
      if (engine_.poses()[c.value] != engine_.poses()[set[0].value])
        raise_usage("'" + assembly()[c].name + "' cannot be grabbed with '" + assembly()[set[0]].name +
                    "' (their poses differ); move them one after the other");
    without_gil([&] { engine_.grab(set); });
  }

  StepView step(const DoubleArray& target, const std::string& response) {
    const Turn turn(mutex_, kName);
    check_held();
    const Pose pose = pose_of(target);
    const ResponseKind kind = response_of(response);
    return {states_->assembly, without_gil([&] { return engine_.step(pose, kind); })};
  }

  void jump(const DoubleArray& array) {
    const Turn turn(mutex_, kName);
    const Poses poses(array);
    if (poses.span().size() != assembly().components.size())
      raise_usage("the state cannot be taken on (it has " + std::to_string(poses.span().size()) + " poses); give " +
                  std::to_string(assembly().components.size()) + ", one a component");
    without_gil([&] { engine_.jump(poses.span()); });
  }

  py::array_t<double> poses() {
    const Turn turn(mutex_, kName);
    return to_array(engine_.poses());
  }
  std::vector<std::string> held() const { return component_names(assembly(), engine_.moving_set()); }

  std::vector<FirstContact> first_contacts(const DoubleArray& targets) {
    const Turn turn(mutex_, kName);
    check_held();
    const Poses poses(targets);
    std::vector<FirstContact> found(poses.span().size());
    without_gil([&] {
      executor_.for_each_heavy(found.size(), [&](std::size_t i) { found[i] = engine_.first_contact(poses.span()[i]); });
    });
    return found;
  }

  Clearance clearance() {
    const Turn turn(mutex_, kName);
    check_held();
    return without_gil([&] { return engine_.clearance(); });
  }

  StepView contacts(double reach) {
    const Turn turn(mutex_, kName);
    check_held();
    if (!(reach >= 0)) raise_usage("contacts cannot be looked for (the reach is negative); give 0 or more");
    StepView view{states_->assembly, {}};
    view.result.pose = engine_.poses()[engine_.moving_set()[0].value];
    view.result.contact_points = without_gil([&] { return engine_.contacts(reach); });
    return view;
  }

 private:
  static constexpr const char* kName = "engine";

  void check_held() const {
    if (engine_.moving_set().empty())
      raise_usage("no component is held (hold was not called, or a jump released it); call hold first");
  }

  CheckedHolder states_;
  Executor executor_;
  CertificateEngine engine_;
  std::mutex mutex_;
};

/// Candidate motions on CPU threads or a CUDA device.
class Batch {
 public:
  Batch(const CheckedHolder& states, const std::string& device, int threads) : states_(states) {
    const std::pair<const char*, DeviceChoice> choices[] = {
        {"cpu", DeviceChoice::Cpu}, {"cuda", DeviceChoice::Cuda}, {"auto", DeviceChoice::Auto}};
    for (const auto& [name, choice] : choices)
      if (device == name) chosen_ = make_motion_batch(*states->assembly, states->pairs, executor_of(threads), choice);
    if (!chosen_.batch)
      raise_usage("there is no device '" + device + "' (it is 'cpu', 'cuda' or 'auto'); give one of these");
  }

  const std::string& device() const { return chosen_.device; }

  void set_state(const py::object& moving, const py::object& poses) {
    const Turn turn(mutex_, kName);
    const Assembly& assembly = *states_->assembly;
    const std::vector<ComponentId> set = components_of(assembly, moving);
    std::vector<Pose> all(assembly.components.size());
    if (!poses.is_none()) {
      const Poses given(poses.cast<DoubleArray>());
      if (given.span().size() != all.size())
        raise_usage("the state cannot be used (it needs a pose a component); give all");
      all.assign(given.span().begin(), given.span().end());
    }
    if (set.empty()) raise_usage("nothing can move (no component is named); name at least one");
    for (const ComponentId c : set)
      if (all[c.value] != all[set[0].value])
        raise_usage("the set cannot move as one (its poses differ); give one pose");
    without_gil([&] { chosen_.batch->set_state(all, set); });
    has_state_ = true;
  }

  std::vector<FirstContact> straight(const DoubleArray& ways) {
    const Turn turn(mutex_, kName);
    check_state();
    if (ways.ndim() != 2 || ways.shape(1) != 3)
      raise_usage("the displacements cannot be read (their shape is not (k, 3)); correct it");
    const Span<const Vec3> span(reinterpret_cast<const Vec3*>(ways.data()), static_cast<std::size_t>(ways.shape(0)));
    for (const Vec3& way : span)
      if (!is_finite(way)) raise_usage("a displacement cannot be used (it is not finite); correct it");
    return without_gil([&] { return chosen_.batch->straight_contacts(span); });
  }
  std::vector<FirstContact> screws(const DoubleArray& targets) {
    const Turn turn(mutex_, kName);
    check_state();
    const Poses poses(targets);
    return without_gil([&] { return chosen_.batch->screw_contacts(poses.span()); });
  }

 private:
  static constexpr const char* kName = "batch";

  void check_state() const {
    if (!has_state_) raise_usage("there is nothing to move (set_state was not called); call it first");
  }

  CheckedHolder states_;
  ChosenMotionBatch chosen_;
  bool has_state_ = false;
  std::mutex mutex_;
};

/// Arrays that look at the contacts of a batch, each an array with an entry a candidate.
struct FirstContactArrays {
  py::array_t<double> toi;
  py::array_t<bool> free;
  py::array_t<std::uint32_t> moving, fixed, face_moving, face_fixed;
};

FirstContactArrays arrays_of(std::vector<FirstContact> contacts) {
  const std::size_t n = contacts.size();
  const auto [owner, first] = keep(std::move(contacts));
  const auto ids = [&, &kept = owner, data = first](const std::uint32_t* values) {
    return look_at<std::uint32_t, FirstContact>(data ? values : nullptr, n, kept);
  };
  if (n == 0) return {};
  return {look_at<double, FirstContact>(&first->toi, n, owner),
          look_at<bool, FirstContact>(&first->free, n, owner),
          ids(&first->moving.value),
          ids(&first->fixed.value),
          ids(&first->face_moving.value),
          ids(&first->face_fixed.value)};
}

/// Names of what stopped a step, each once.
std::set<std::string> blocking(const StepView& step) {
  std::set<std::string> names;
  for (const ContactPoint& c : step.result.contact_points) names.insert((*step.assembly)[c.fixed].name);
  return names;
}

template <class Value, class Get>
py::array_t<Value> column(const StepView& step, const Get& get) {
  py::array_t<Value> array(static_cast<py::ssize_t>(step.result.contact_points.size()));
  for (std::size_t i = 0; i < step.result.contact_points.size(); ++i)
    array.mutable_data()[i] = get(step.result.contact_points[i]);
  return array;
}

template <class Get>
py::array_t<double> vectors(const StepView& step, const Get& get) {
  py::array_t<double> array({static_cast<py::ssize_t>(step.result.contact_points.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < step.result.contact_points.size(); ++i) {
    const Vec3 v = get(step.result.contact_points[i]);
    for (int k = 0; k < 3; ++k) array.mutable_data()[3 * i + static_cast<std::size_t>(k)] = v[k];
  }
  return array;
}

void bind_step(py::module_& module) {
  py::class_<StepView>(module, "StepResult", "How one step towards a target ended, and what it cost.")
      .def_property_readonly(
          "pose", [](const StepView& s) { return to_array(s.result.pose); }, "Shape (7,).")
      .def_property_readonly("reached", [](const StepView& s) { return s.result.reached; })
      .def_property_readonly(
          "way", [](const StepView& s) { return to_array(Span<const Pose>(s.result.poses)); },
          "The poses that it went through, a screw from each to the next, shape (n, 7).")
      .def_property_readonly(
          "clearance", [](const StepView& s) { return s.result.clearance; },
          "A lower bound of the distance to everything else [mm].")
      .def_property_readonly("blocking", &blocking, "The names of what it touches.")
      .def_property_readonly(
          "points", [](const StepView& s) { return vectors(s, [](const ContactPoint& c) { return c.point; }); },
          "Contact points [mm, world], shape (n, 3).")
      .def_property_readonly(
          "normals", [](const StepView& s) { return vectors(s, [](const ContactPoint& c) { return c.normal; }); },
          "From the fixed component to the moving one, shape (n, 3).")
      .def_property_readonly(
          "gaps", [](const StepView& s) { return column<double>(s, [](const ContactPoint& c) { return c.gap; }); },
          "[mm], shape (n,).")
      .def_property_readonly(
          "moving",
          [](const StepView& s) {
            return column<std::uint32_t>(s, [](const ContactPoint& c) { return c.moving.value; });
          },
          "Indices of components, shape (n,).")
      .def_property_readonly(
          "fixed",
          [](const StepView& s) {
            return column<std::uint32_t>(s, [](const ContactPoint& c) { return c.fixed.value; });
          },
          "Indices of components, shape (n,).")
      .def_property_readonly("milliseconds", [](const StepView& s) { return s.result.cost.ms; });
}

void bind_contacts(py::module_& module) {
  py::class_<FirstContactArrays>(module, "FirstContacts", "How far each candidate motion gets: an entry a candidate.")
      .def_readonly("toi", &FirstContactArrays::toi, "Free on [0, toi] of the motion.")
      .def_readonly("free", &FirstContactArrays::free)
      .def_readonly("moving", &FirstContactArrays::moving, "Index of a component; meaningless if free.")
      .def_readonly("fixed", &FirstContactArrays::fixed)
      .def_readonly("face_moving", &FirstContactArrays::face_moving)
      .def_readonly("face_fixed", &FirstContactArrays::face_fixed)
      .def("__len__", [](const FirstContactArrays& a) { return a.toi.size(); });
  py::class_<Clearance>(module, "Clearance", "The minimum distance between the moving set and all other components.")
      .def_readonly("distance", &Clearance::distance, "[mm]")
      .def_property_readonly("moving", [](const Clearance& c) { return c.moving.value; })
      .def_property_readonly("fixed", [](const Clearance& c) { return c.fixed.value; })
      .def_property_readonly("point_moving", [](const Clearance& c) { return to_array(c.point_moving); })
      .def_property_readonly("point_fixed", [](const Clearance& c) { return to_array(c.point_fixed); });
}

}  // namespace

ResponseKind response_of(const std::string& name) {
  for (const ResponseKind kind : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide})
    if (name_of(kind) == name) return kind;
  raise_usage("there is no response '" + name + "' (it is 'stop', 'touch' or 'slide'); give one of these");
}

void bind_engine(py::module_& module) {
  bind_step(module);
  bind_contacts(module);
  py::class_<Engine>(module, "Engine", "Grabs components and moves them towards targets, with collision handling.")
      .def(py::init<CheckedHolder, int>(), py::arg("states"), py::kw_only(), py::arg("threads") = 1)
      .def("hold", &Engine::hold, py::arg("components"))
      .def("step", &Engine::step, py::arg("target"), py::arg("response") = "slide")
      .def("jump", &Engine::jump, py::arg("poses"))
      .def_property_readonly("poses", &Engine::poses, "Of all components, shape (n, 7).")
      .def_property_readonly("held", &Engine::held)
      .def(
          "first_contacts",
          [](Engine& engine, const DoubleArray& targets) { return arrays_of(engine.first_contacts(targets)); },
          py::arg("targets"), "The first contact of the screw motion to each target, shape (k, 7). Nothing moves.")
      .def("clearance", &Engine::clearance)
      .def("contacts", &Engine::contacts, py::arg("reach"), "All contacts nearer than `reach` [mm].");
  py::class_<Batch>(module, "MotionBatch", "Many candidate motions of one set, on CPU threads or a CUDA device.")
      .def(py::init<CheckedHolder, std::string, int>(), py::arg("states"), py::kw_only(), py::arg("device") = "auto",
           py::arg("threads") = 0)
      .def_property_readonly("device", &Batch::device)
      .def("set_state", &Batch::set_state, py::arg("moving"), py::arg("poses") = py::none())
      .def(
          "straight_contacts", [](Batch& b, const DoubleArray& ways) { return arrays_of(b.straight(ways)); },
          py::arg("ways"), "First contacts of translations by these displacements [mm], shape (k, 3).")
      .def(
          "screw_contacts", [](Batch& b, const DoubleArray& targets) { return arrays_of(b.screws(targets)); },
          py::arg("targets"), "Screws to poses, shape (k, 7).");
}

}  // namespace dismantle::python
