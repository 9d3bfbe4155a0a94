// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/certificates/certificate_engine.h"
#include "python/src/step_result.h"

#include <set>

namespace dismantle::python {

namespace {

/// An engine of the method `certificates`, used by one thread at a time.
class Engine {
 public:
  Engine(const CheckedHolder& states, int threads)
      : states_(states),
        executor_(executor_of(threads)),
        engine_(*states->assembly, states->pairs, engine_options(states, threads)) {}

  const Assembly& assembly() const { return *states_->assembly; }

  void hold(const py::object& keys) {
    const ExclusiveUse use(mutex_, kName);
    const std::vector<ComponentId> set = components_of(assembly(), keys);
    if (set.empty()) raise_usage("nothing can be grabbed (no component is named); name at least one");
    for (const ComponentId c : set)
      if (engine_.poses()[c.value] != engine_.poses()[set[0].value])
        raise_usage("'" + assembly()[c].name + "' cannot be grabbed with '" + assembly()[set[0]].name +
                    "' (their poses differ); move them one after the other");
    without_gil([&] { engine_.grab(set); });
  }

  StepView step(const DoubleArray& target, const std::string& response) {
    const ExclusiveUse use(mutex_, kName);
    check_held();
    const Pose pose = pose_of(target);
    const ResponseKind kind = response_of(response);
    return {states_->assembly, without_gil([&] { return engine_.step(pose, kind); })};
  }

  void jump(const DoubleArray& array) {
    const ExclusiveUse use(mutex_, kName);
    const Poses poses(array);
    if (poses.span().size() != assembly().components.size())
      raise_usage("the poses cannot be used (there are " + std::to_string(poses.span().size()) + "); give " +
                  std::to_string(assembly().components.size()) + ", one for each component");
    without_gil([&] { engine_.jump(poses.span()); });
  }

  py::array_t<double> poses() {
    const ExclusiveUse use(mutex_, kName);
    return to_array(engine_.poses());
  }
  std::vector<std::string> held() const { return component_names(assembly(), engine_.moving_set()); }

  std::vector<FirstContact> first_contacts(const DoubleArray& targets) {
    const ExclusiveUse use(mutex_, kName);
    check_held();
    const Poses poses(targets);
    std::vector<FirstContact> found(poses.span().size());
    without_gil([&] {
      executor_.for_each_heavy(found.size(), [&](std::size_t i) { found[i] = engine_.first_contact(poses.span()[i]); });
    });
    return found;
  }

  Clearance clearance() {
    const ExclusiveUse use(mutex_, kName);
    check_held();
    return without_gil([&] { return engine_.clearance(); });
  }

  StepView contacts(double reach) {
    const ExclusiveUse use(mutex_, kName);
    check_held();
    if (!(reach >= 0)) raise_usage("contacts cannot be found (the reach is negative); give 0 or more");
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
    const ExclusiveUse use(mutex_, kName);
    const Assembly& assembly = *states_->assembly;
    const std::vector<ComponentId> set = components_of(assembly, moving);
    std::vector<Pose> all(assembly.components.size());
    if (!poses.is_none()) {
      const Poses given(poses.cast<DoubleArray>());
      if (given.span().size() != all.size())
        raise_usage("the state cannot be used (it needs a pose for each component); give all");
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
    const ExclusiveUse use(mutex_, kName);
    check_state();
    if (ways.ndim() != 2 || ways.shape(1) != 3)
      raise_usage("the displacements cannot be read (their shape is not (k, 3)); correct it");
    const Span<const Vec3> span(reinterpret_cast<const Vec3*>(ways.data()), static_cast<std::size_t>(ways.shape(0)));
    for (const Vec3& way : span)
      if (!is_finite(way)) raise_usage("a displacement cannot be used (it is not finite); correct it");
    return without_gil([&] { return chosen_.batch->straight_contacts(span); });
  }
  std::vector<FirstContact> screws(const DoubleArray& targets) {
    const ExclusiveUse use(mutex_, kName);
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

/// Arrays that view first contacts, with an entry for each motion.
struct FirstContactArrays {
  py::array_t<double> toi;
  py::array_t<bool> free;
  py::array_t<std::uint32_t> moving, fixed, face_moving, face_fixed;
};

FirstContactArrays arrays_of(std::vector<FirstContact> contacts) {
  const std::size_t n = contacts.size();
  const auto [owner, first] = make_owner(std::move(contacts));
  const auto ids = [&, &kept = owner, data = first](const std::uint32_t* values) {
    return array_view<std::uint32_t, FirstContact>(data ? values : nullptr, n, kept);
  };
  if (n == 0) return {};
  return {array_view<double, FirstContact>(&first->toi, n, owner),
          array_view<bool, FirstContact>(&first->free, n, owner),
          ids(&first->moving.value),
          ids(&first->fixed.value),
          ids(&first->face_moving.value),
          ids(&first->face_fixed.value)};
}

/// Names of the components in contact after a step.
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
  py::class_<StepView>(
      module, "StepResult",
      "Result of one step towards a target. Arrays with an entry for each contact have the same order.")
      .def_property_readonly(
          "pose", [](const StepView& s) { return to_array(s.result.pose); },
          "Pose of the moving set after the step, shape (7,).")
      .def_property_readonly(
          "reached", [](const StepView& s) { return s.result.reached; }, "True if the pose is the target.")
      .def_property_readonly(
          "way", [](const StepView& s) { return to_array(Span<const Pose>(s.result.poses)); },
          "The poses passed through, with a screw motion from each to the next, shape (n, 7).")
      .def_property_readonly(
          "clearance", [](const StepView& s) { return s.result.clearance; },
          "Lower bound of the distance to all other components [mm].")
      .def_property_readonly("blocking", &blocking, "Names of the components that the moving set touches.")
      .def_property_readonly(
          "points", [](const StepView& s) { return vectors(s, [](const ContactPoint& c) { return c.point; }); },
          "Contact points [mm, world frame], shape (n, 3).")
      .def_property_readonly(
          "normals", [](const StepView& s) { return vectors(s, [](const ContactPoint& c) { return c.normal; }); },
          "Unit normals from the fixed component to the moving one [world frame], shape (n, 3).")
      .def_property_readonly(
          "gaps", [](const StepView& s) { return column<double>(s, [](const ContactPoint& c) { return c.gap; }); },
          "Gaps along the normals [mm], shape (n,); negative: overlap.")
      .def_property_readonly(
          "moving",
          [](const StepView& s) {
            return column<std::uint32_t>(s, [](const ContactPoint& c) { return c.moving.value; });
          },
          "Indices of the moving components in contact, shape (n,).")
      .def_property_readonly(
          "fixed",
          [](const StepView& s) {
            return column<std::uint32_t>(s, [](const ContactPoint& c) { return c.fixed.value; });
          },
          "Indices of the other components in contact, shape (n,).")
      .def_property_readonly(
          "milliseconds", [](const StepView& s) { return s.result.cost.ms; }, "Duration of the step [ms].");
}

void bind_contacts(py::module_& module) {
  py::class_<FirstContactArrays>(
      module, "FirstContacts", "First contacts of candidate motions: arrays with an entry for each motion, shape (k,).")
      .def_readonly("toi", &FirstContactArrays::toi,
                    "Time of impact: the motion is free on [0, toi], as a fraction of the motion.")
      .def_readonly("free", &FirstContactArrays::free, "True if the whole motion is free.")
      .def_readonly("moving", &FirstContactArrays::moving,
                    "Index of the moving component in contact; undefined if free.")
      .def_readonly("fixed", &FirstContactArrays::fixed, "Index of the other component; undefined if free.")
      .def_readonly("face_moving", &FirstContactArrays::face_moving, "Face of the moving component; undefined if free.")
      .def_readonly("face_fixed", &FirstContactArrays::face_fixed, "Face of the other component; undefined if free.")
      .def("__len__", [](const FirstContactArrays& a) { return a.toi.size(); });
  py::class_<Clearance>(module, "Clearance",
                        "Exact minimum distance between the moving set and all other components, and its location.")
      .def_readonly("distance", &Clearance::distance, "Distance [mm]; infinite if there is no other component.")
      .def_property_readonly(
          "moving", [](const Clearance& c) { return c.moving.value; }, "Index of the moving component.")
      .def_property_readonly(
          "fixed", [](const Clearance& c) { return c.fixed.value; }, "Index of the other component.")
      .def_property_readonly(
          "point_moving", [](const Clearance& c) { return to_array(c.point_moving); },
          "Nearest point of the moving component [mm, world frame], shape (3,).")
      .def_property_readonly(
          "point_fixed", [](const Clearance& c) { return to_array(c.point_fixed); },
          "Nearest point of the other component [mm, world frame], shape (3,).");
}

}  // namespace

CertificateOptions engine_options(const CheckedHolder& states, int threads) {
  CertificateOptions options{executor_of(threads), widest_lanes()};
  options.prepared = without_gil([&] {
    const std::lock_guard lock(*states->preparing);
    if (!states->prepared) states->prepared = CertificateEngine(*states->assembly, states->pairs, options).surfaces();
    return states->prepared;
  });
  return options;
}

std::shared_ptr<const AssemblySurfaces> prepared_already(const CheckedHolder& states) {
  const std::unique_lock lock(*states->preparing, std::try_to_lock);
  return lock ? states->prepared : nullptr;
}

ResponseKind response_of(const std::string& name) {
  for (const ResponseKind kind : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide})
    if (name_of(kind) == name) return kind;
  raise_usage("there is no response '" + name + "' (it is 'stop', 'touch' or 'slide'); give one of these");
}

void bind_engine(py::module_& module) {
  bind_step(module);
  bind_contacts(module);
  py::class_<Engine>(
      module, "Engine",
      "Moves grabbed components towards targets, with collision handling. One thread may use it at a time.")
      .def(py::init<CheckedHolder, int>(), py::arg("states"), py::kw_only(), py::arg("threads") = 1)
      .def("hold", &Engine::hold, py::arg("components"),
           "Grabs components, which move together as one rigid body from then on. They must have equal poses.")
      .def(
          "step", &Engine::step, py::arg("target"), py::arg("response") = "slide",
          "Moves the set towards a target pose, shape (7,), as far as the response allows: 'stop', 'touch' or 'slide'.")
      .def("jump", &Engine::jump, py::arg("poses"),
           "Sets the poses of all components, shape (n, 7), without a test. Releases the set if that moves it.")
      .def_property_readonly("poses", &Engine::poses, "Poses of all components, shape (n, 7).")
      .def_property_readonly("held", &Engine::held, "Names of the grabbed components.")
      .def(
          "first_contacts",
          [](Engine& engine, const DoubleArray& targets) { return arrays_of(engine.first_contacts(targets)); },
          py::arg("targets"), "First contacts of the screw motions to target poses, shape (k, 7). Nothing moves.")
      .def("clearance", &Engine::clearance, "Exact minimum distance between the set and all other components.")
      .def("contacts", &Engine::contacts, py::arg("reach"),
           "All contacts with a gap of at most `reach` [mm]; the members that describe a motion are empty.");
  py::class_<Batch>(
      module, "MotionBatch",
      "Tests many candidate motions of one set, on CPU threads or a CUDA device. One thread may use it at a time.")
      .def(py::init<CheckedHolder, std::string, int>(), py::arg("states"), py::kw_only(), py::arg("device") = "auto",
           py::arg("threads") = 0)
      .def_property_readonly("device", &Batch::device, "'cpu', or the name of the CUDA device.")
      .def("set_state", &Batch::set_state, py::arg("moving"), py::arg("poses") = py::none(),
           "Sets the moving set, and the poses of all components, shape (n, 7); without `poses`: assembled.")
      .def(
          "straight_contacts", [](Batch& b, const DoubleArray& ways) { return arrays_of(b.straight(ways)); },
          py::arg("ways"), "First contacts of translations by displacements [mm, world frame], shape (k, 3).")
      .def(
          "screw_contacts", [](Batch& b, const DoubleArray& targets) { return arrays_of(b.screws(targets)); },
          py::arg("targets"), "First contacts of the screw motions to target poses, shape (k, 7).");
}

}  // namespace dismantle::python
