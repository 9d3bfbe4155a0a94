// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/plan_text.h"

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNamesInFull = 4;

}  // namespace

Result<ComponentId> find_component(const Assembly& assembly, const std::string& name) {
  const std::optional<ComponentId> id = assembly.find(name);
  if (!id)
    return Error{ErrorKind::Usage,
                 "'" + name + "' is unknown (the assembly has no component of that name); 'dismantle info' lists them"};
  return *id;
}

std::string names_text(const Assembly& assembly, const std::vector<ComponentId>& components) {
  std::string text;
  for (std::size_t i = 0; i < components.size() && i < kNamesInFull; ++i)
    text += (i > 0 ? ", " : "") + assembly[components[i]].name;
  if (components.size() > kNamesInFull) text += " and " + std::to_string(components.size() - kNamesInFull) + " more";
  return text;
}

Json names_json(const Assembly& assembly, const std::vector<ComponentId>& components) {
  Json names = Json::array();
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  return names;
}

Json explanation_json(const Assembly& assembly, const Explanation& e) {
  Json blockers = Json::array();
  for (const Blocker& b : e.blockers)
    blockers.push_back({{"component", assembly[b.component].name},
                        {"after_mm", b.contact.distance},
                        {"contact", {b.contact.point.x, b.contact.point.y, b.contact.point.z}}});
  return {{"component", assembly[e.component].name},
          {"direction", {e.direction.x, e.direction.y, e.direction.z}},
          {"along", direction_text(e.direction)},
          {"blocked_by", blockers},
          {"comes_out_with", names_json(assembly, e.together)},
          {"locked_with", names_json(assembly, e.locked)}};
}

}  // namespace dismantle::cli
