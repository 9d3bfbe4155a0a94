// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/plan_text.h"

#include "dismantle/files/similar_names.h"

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

Json id_json(const Assembly& assembly, ComponentId c) {
  return c.valid() ? Json(assembly[c].name) : Json(nullptr);
}

Json unscrewing_json(const Unscrewing& u) {
  return {{"turns", u.turns > 0 ? Json(u.turns) : Json(nullptr)},
          {"travel_mm", u.travel},
          {"pitch_mm", u.pitch > 0 ? Json(u.pitch) : Json(nullptr)},
          {"left_handed", u.left_handed},
          {"nominal", u.nominal}};
}

Json joint_json(const Assembly& assembly, const Joint& joint) {
  std::vector<ComponentId> inserts;
  for (const NutInsert& ring : joint.nut_inserts) inserts.push_back(ring.insert);
  return {{"screw", id_json(assembly, joint.screw)},
          {"nuts", names_json(assembly, joint.nuts)},
          {"head_washers", names_json(assembly, joint.head_washers)},
          {"nut_washers", names_json(assembly, joint.nut_washers)},
          {"nut_inserts", names_json(assembly, inserts)},
          {"held", names_json(assembly, joint.held)},
          {"thread_in", id_json(assembly, joint.thread_in)},
          {"has_head", joint.has_head},
          {"axis", {joint.axis.x, joint.axis.y, joint.axis.z}}};
}

}  // namespace

Result<ComponentId> find_component(const Assembly& assembly, const std::string& name) {
  if (const std::optional<ComponentId> id = assembly.find(name)) return *id;
  std::vector<std::string> names;
  for (const Component& c : assembly.components) names.push_back(c.name);
  const std::string meant = did_you_mean(name, names);
  return Error{ErrorKind::Usage, "'" + name + "' is unknown (the assembly has no component of that name)" + meant +
                                     (meant.empty() ? "; " : " ") + "'dismantle info' lists them"};
}

Json names_json(const Assembly& assembly, const std::vector<ComponentId>& components) {
  Json names = Json::array();
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  return names;
}

Json overlap_json(const Assembly& assembly, const LeastOverlap& overlap) {
  Json pairs = Json::array();
  for (const NeededOverlap& p : overlap.pairs)
    pairs.push_back({{"a", assembly[p.moving].name},
                     {"b", assembly[p.fixed].name},
                     {"depth_mm", p.depth},
                     {"more_mm", p.more},
                     {"at", {p.at.x, p.at.y, p.at.z}}});
  return {{"direction", {overlap.direction.x, overlap.direction.y, overlap.direction.z}},
          {"along", direction_text(overlap.direction)},
          {"more_mm", overlap.more},
          {"pairs", pairs}};
}

Json explanation_json(const Assembly& assembly, const Explanation& e) {
  Json blockers = Json::array();
  for (const Blocker& b : e.blockers)
    blockers.push_back({{"component", assembly[b.component].name},
                        {"after_mm", b.contact.distance},
                        {"contact", {b.contact.point.x, b.contact.point.y, b.contact.point.z}}});
  return {{"component", assembly[e.component].name},
          {"group", names_json(assembly, e.group)},
          {"direction", {e.direction.x, e.direction.y, e.direction.z}},
          {"along", direction_text(e.direction)},
          {"blocked_by", blockers},
          {"comes_out_with", names_json(assembly, e.together)},
          {"locked_with", names_json(assembly, e.locked)},
          {"comes_out_with_overlap", e.overlap ? overlap_json(assembly, *e.overlap) : Json(nullptr)}};
}

Json plan_json(const Assembly& a, const Plan& plan, const Path& path) {
  Json steps = Json::array(), staying = Json::array(), tiers = Json::object(), joints = Json::array();
  for (const PlanStep& step : plan.steps) {
    steps.push_back({{"components", names_json(a, step.components)},
                     {"tier", name_of(step.tier)},
                     {"part_of_step", step.part_of == PlanStep::kWhole ? Json(nullptr) : Json(step.part_of)},
                     {"exit", {step.exit.x, step.exit.y, step.exit.z}}});
    if (step.unscrewing) steps.back()["unscrew"] = unscrewing_json(*step.unscrewing);
    if (!step.still_held_by.empty()) steps.back()["still_held_by"] = names_json(a, step.still_held_by);
    if (step.is_enclosed) steps.back()["enclosed"] = true;
    if (!step.margin) continue;
    steps.back()["margin_mm"] = step.margin->margin;
    const bool is_near = step.margin->nearest.valid();
    steps.back()["nearest"] = is_near ? Json(a[step.margin->nearest].name) : Json(nullptr);
  }
  for (const Explanation& e : plan.staying) staying.push_back(explanation_json(a, e));
  for (const Joint& joint : plan.joints) joints.push_back(joint_json(a, joint));
  for (const auto& [tier, count] : tier_counts(plan)) tiers[std::string(name_of(tier))] = count;
  return {{"format", "dismantle-plan"},
          {"version", 1},
          {"assembly", {{"file", a.source_file}, {"components", a.components.size()}}},
          {"complete", plan.complete()},
          {"out_of_time", plan.out_of_time},
          {"effort_spent", plan.effort_spent},
          {"tiers", tiers},
          {"steps", steps},
          {"joints", joints},
          {"staying", staying},
          {"removed", path.removed}};
}

std::string fastener_text_of(const Assembly& assembly, const PlanStep& step) {
  std::string text;
  if (step.unscrewing) text += ", " + unscrewing_text(*step.unscrewing);
  if (!step.still_held_by.empty()) text += ", still held by " + names_text(assembly, step.still_held_by);
  return text;
}

std::map<PlanTier, std::size_t> tier_counts(const Plan& plan) {
  std::map<PlanTier, std::size_t> counts;
  for (const PlanStep& step : plan.steps) ++counts[step.tier];
  return counts;
}

}  // namespace dismantle::cli
