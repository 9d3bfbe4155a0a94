// SPDX-License-Identifier: Apache-2.0
#include "apps/server/viewer_files.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/export/exported_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/planner/explanation.h"
#include "dismantle/planner/plan_path.h"
#include "dismantle/planner/step_margin.h"
#include "dismantle/planner/step_preference.h"
#include "python/src/path_object.h"

#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace dismantle::python {

namespace {

/// A plan and its assembly: the class Plan.
struct PlanView {
  CheckedHolder states;
  Plan plan;
};

/// An explanation and its assembly: the class Explanation.
struct ExplanationView {
  CheckedHolder states;
  Explanation explanation;
};

/// A step and its assembly: the class PlanStep.
struct StepOfPlan {
  CheckedHolder states;
  PlanStep step;
};

ChosenPreferences preferences_of(const std::vector<std::string>& texts) {
  for (const std::string& text : texts)
    if (!read_preferences({text}))
      raise_usage("the plan cannot prefer '" + text +
                  "' (there is no such preference); give 'direction', 'upright', 'groups', 'support', 'tools' or "
                  "'loose', with a weight above 0 as in 'groups=2' or without");
  const std::optional<ChosenPreferences> chosen = read_preferences(texts);
  if (!chosen) raise_usage("the plan cannot prefer the same thing twice (prefer names it twice); name each once");
  return *chosen;
}

PlanView plan(const CheckedHolder& states, const py::object& targets, const py::object& fixed,
              const std::vector<std::string>& prefer, double time_limit, double effort, bool margins,
              const std::string& fasteners, int threads, const py::object& progress) {
  PythonProgress watched(progress);
  PlanOptions options;
  const ChosenPreferences chosen = preferences_of(prefer);
  options.preferences = chosen.criteria;
  options.preference_weights = chosen.weights;
  options.targets = components_of(*states->assembly, targets);
  options.fixed = components_of(*states->assembly, fixed);
  options.time_limit = time_limit;
  if (fasteners != "first" && fasteners != "any")
    raise_usage("the plan cannot take fasteners '" + fasteners + "' (there is no such order); give 'first' or 'any'");
  options.fasteners = fasteners == "any" ? FastenerOrder::Ignored : FastenerOrder::First;
  options.engine.executor = executor_of(threads);
  options.engine.prepared = prepared_already(states);
  options.progress = watched.callback();
  if (!(time_limit >= 0)) raise_usage("the plan cannot be made (the time limit is negative); give 0 for none");
  if (!(effort >= 0 && effort <= 1e6))
    raise_usage("the plan cannot be made (the effort is not from 0 to 1e6); give 1 for the usual one");
  options.search_longer(effort);
  for (const ComponentId c : options.targets)
    if (std::find(options.fixed.begin(), options.fixed.end(), c) != options.fixed.end())
      raise_usage("'" + (*states->assembly)[c].name +
                  "' cannot be removed (it is both target and fixed); leave out one of the two");
  PlanView view{states, without_gil([&] {
                  Plan found = plan_disassembly(*states->assembly, states->pairs, options);
                  if (margins) find_margins(*states->assembly, states->pairs, options.engine, options.progress, found);
                  return found;
                })};
  watched.finish();
  return view;
}

ExplanationView why(const CheckedHolder& states, const py::object& component, int threads) {
  const ComponentId id = component_of(*states->assembly, component);
  PlanOptions options;
  options.engine = engine_options(states, threads);
  return {states, without_gil([&] { return why_blocked(*states->assembly, states->pairs, id, options); })};
}

/// A report with the names of components.
struct AuditView {
  AuditReport report;
  std::vector<std::string> names;  // of all components

  std::vector<std::pair<std::string, std::string>> pairs(PathPairState state) const {
    std::vector<std::pair<std::string, std::string>> list;
    for (const AuditPair& pair : report.pairs)
      if (pair.state == state) list.emplace_back(names[pair.a.value], names[pair.b.value]);
    return list;
  }
};

AuditView audit(const Assembly& assembly, const Path& path, int threads, const py::object& progress) {
  PythonProgress watched(progress);
  const AuditOptions options{executor_of(threads), watched.callback()};
  AuditView view{without_gil([&] { return audit_path(assembly, path, options); }), {}};
  watched.finish();
  for (const Component& c : assembly.components) view.names.push_back(c.name);
  return view;
}

void export_file(const Assembly& assembly, const Path& path, const std::filesystem::path& file, bool reverse,
                 const py::object& progress) {
  const std::optional<ExportFormat> format = export_format_of(file.string());
  if (!format || has_own_writer(*format))
    raise_usage(file.string() +
                " cannot be written (its extension is not a known format); use .glb, .html, .csv, "
                "bom.csv, bom.json or .path.json");
  PythonProgress watched(progress);
  ExportOptions options;
  options.direction = reverse ? PathDirection::Reversed : PathDirection::Forward;
  options.viewer = server::viewer_files();
  options.progress = watched.callback();
  Result<std::string> bytes = without_gil([&] { return exported_file(*format, assembly, path, options); });
  watched.finish();
  value_or_raise(write_file(file, value_or_raise(std::move(bytes))));
}

std::vector<std::string> blockers(const ExplanationView& view) {
  std::vector<ComponentId> found;
  for (const Blocker& b : view.explanation.blockers) found.push_back(b.component);
  return component_names(*view.states->assembly, found);
}

void bind_explanation(py::module_& module) {
  py::class_<ExplanationView>(module, "Explanation",
                              "The blockers of the straight removal of a component. str() gives a sentence.")
      .def_property_readonly(
          "component", [](const ExplanationView& e) { return (*e.states->assembly)[e.explanation.component].name; },
          "Name of the component.")
      .def_property_readonly(
          "direction", [](const ExplanationView& e) { return to_array(e.explanation.direction); },
          "The direction with the fewest blockers: unit vector, shape (3,).")
      .def_property_readonly("blocked_by", &blockers,
                             "Names of the blockers along the direction, nearest first; empty if it can be removed.")
      .def_property_readonly(
          "comes_out_with",
          [](const ExplanationView& e) { return component_names(*e.states->assembly, e.explanation.together); },
          "Names of the components that can be removed with it as one body; empty if there is no such body.")
      .def_property_readonly(
          "locked_with",
          [](const ExplanationView& e) { return component_names(*e.states->assembly, e.explanation.locked); },
          "Names of the components with which it is interlocked.")
      .def("__str__", [](const ExplanationView& e) { return explanation_text(*e.states->assembly, e.explanation); });
}

void bind_plan_classes(py::module_& module) {
  py::class_<StepOfPlan>(module, "PlanStep", "A step of a plan: the removal of a set of components.")
      .def_property_readonly(
          "components", [](const StepOfPlan& s) { return component_names(*s.states->assembly, s.step.components); },
          "Names of the components that move.")
      .def_property_readonly(
          "tier", [](const StepOfPlan& s) { return std::string(name_of(s.step.tier)); },
          "Kind of the path: 'straight', 'helical', 'sliding', 'sampled' or 'straight together' (several components).")
      .def_property_readonly(
          "exit", [](const StepOfPlan& s) { return to_array(s.step.exit); },
          "Direction of the removal at the end of the path: unit vector, shape (3,).")
      .def_property_readonly(
          "part_of",
          [](const StepOfPlan& s) -> std::optional<std::uint32_t> {
            if (s.step.part_of == PlanStep::kWhole) return {};
            return s.step.part_of;
          },
          "Index of the step that removed the body from which this step removes the set; None: the assembly.")
      .def_property_readonly(
          "margin",
          [](const StepOfPlan& s) -> std::optional<double> {
            if (!s.step.margin) return {};
            return s.step.margin->margin;
          },
          "By how much all surfaces could grow before the motion would not be free [mm]: half the smallest distance to "
          "components that are not touched in the assembled state. None without plan(margins=True).")
      .def_property_readonly(
          "nearest",
          [](const StepOfPlan& s) -> std::optional<std::string> {
            if (!s.step.margin || !s.step.margin->nearest.valid()) return {};
            return (*s.states->assembly)[s.step.margin->nearest].name;
          },
          "Name of the component at twice the margin; None if nothing is near.")
      .def_property_readonly(
          "unscrew",
          [](const StepOfPlan& s) -> std::optional<std::string> {
            if (!s.step.unscrewing) return {};
            return unscrewing_text(*s.step.unscrewing);
          },
          "How a fastener is turned out of its thread: 'unscrew 12 turns anticlockwise, 9.6 mm (nominal pitch 0.8 "
          "mm)'. "
          "None for all other steps.")
      .def_property_readonly(
          "turns",
          [](const StepOfPlan& s) -> std::optional<double> {
            if (!s.step.unscrewing || !(s.step.unscrewing->turns > 0)) return {};
            return s.step.unscrewing->turns;
          },
          "Number of turns until the thread ends; None without a thread, or where its pitch is unknown.")
      .def_property_readonly(
          "still_held_by",
          [](const StepOfPlan& s) { return component_names(*s.states->assembly, s.step.still_held_by); },
          "Names of the fasteners that still hold what moves; empty unless there was no other step.");
  py::class_<PlanView>(module, "Plan", "A disassembly sequence.")
      .def_property_readonly(
          "steps",
          [](const PlanView& p) {
            std::vector<StepOfPlan> steps;
            for (const PlanStep& s : p.plan.steps) steps.push_back({p.states, s});
            return steps;
          },
          "The steps in order.")
      .def_property_readonly(
          "staying",
          [](const PlanView& p) {
            std::vector<ExplanationView> staying;
            for (const Explanation& e : p.plan.staying) staying.push_back({p.states, e});
            return staying;
          },
          "An Explanation for each target that cannot be removed.")
      .def_property_readonly(
          "complete", [](const PlanView& p) { return p.plan.complete(); }, "True if all targets can be removed.")
      .def_property_readonly(
          "out_of_time", [](const PlanView& p) { return p.plan.out_of_time; },
          "True if the search ended at the time limit or was cancelled.")
      .def_property_readonly(
          "effort_spent", [](const PlanView& p) { return p.plan.effort_spent; },
          "True if searches for targets that stay ended because their effort was spent: a larger effort may find more.")
      .def_property_readonly(
          "seconds", [](const PlanView& p) { return p.plan.seconds; }, "Duration of the search [s].")
      .def(
          "path",
          [](const PlanView& p) {
            return shared_path(without_gil([&] { return plan_path(*p.states->assembly, p.states->pairs, p.plan); }));
          },
          "The path of the plan, with a move for each step.");
}

void bind_audit(py::module_& module) {
  py::class_<AuditView>(module, "AuditReport", "Result of audit().")
      .def_property_readonly(
          "holds", [](const AuditView& v) { return v.report.holds(); },
          "True if the path satisfies the guarantee, apart from the unchecked pairs.")
      .def_property_readonly(
          "violations",
          [](const AuditView& view) {
            std::vector<std::string> sentences;
            for (const AuditViolation& v : view.report.violations) sentences.push_back(v.message);
            return sentences;
          },
          "The violations, a sentence each.")
      .def_property_readonly(
          "unchecked", [](const AuditView& v) { return v.pairs(PathPairState::Free); },
          "Names of the pairs that are not checked until they have been apart: those that the path calls free.")
      .def_property_readonly(
          "declared", [](const AuditView& v) { return v.pairs(PathPairState::Declared); },
          "Names of the pairs that the user allowed to get deeper.")
      .def_property_readonly(
          "seconds", [](const AuditView& v) { return v.report.seconds; }, "Duration of the audit [s].");
}

}  // namespace

void bind_plan(py::module_& module) {
  bind_explanation(module);
  bind_plan_classes(module);
  bind_audit(module);
  module.def(
      "plan", &plan, py::arg("states"), py::kw_only(), py::arg("targets") = py::none(), py::arg("fixed") = py::none(),
      py::arg("prefer") = py::tuple(), py::arg("time_limit") = 0.0, py::arg("effort") = 1.0, py::arg("margins") = false,
      py::arg("fasteners") = "first", py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Finds a disassembly sequence of everything, or of `targets`; components in `fixed` never move. `prefer`: what "
      "makes an order of steps good: 'direction', 'upright', 'groups', 'support', 'tools', 'loose'; the first counts "
      "most, or each by its weight, as in 'groups=2'. "
      "`time_limit` [s]; 0: none. `effort`: factor of the effort for paths that are not straight. `margins`: "
      "find PlanStep.margin. `fasteners`: 'first', before what they hold, or 'any'.");
  module.def("why", &why, py::arg("states"), py::arg("component"), py::kw_only(), py::arg("threads") = 0,
             "Finds the blockers of the straight removal of a component.");
  module.def(
      "audit", &audit, py::arg("assembly"), py::arg("path"), py::kw_only(), py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "Checks that nothing in a path gets deeper than allowed and nothing passes through, independently of engine "
      "and planner.");
  module.def("export", &export_file, py::arg("assembly"), py::arg("path"), py::arg("file"), py::kw_only(),
             py::arg("reverse") = false, py::arg("progress") = py::none(),
             "Writes a file whose name gives the format: .glb, .html, .csv, bom.csv, bom.json or .path.json. "
             "`reverse`: assembly "
             "instead of disassembly.");
}

}  // namespace dismantle::python
