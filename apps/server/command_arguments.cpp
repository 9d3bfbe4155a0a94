// SPDX-License-Identifier: Apache-2.0
#include "apps/server/command_arguments.h"

#include "apps/server/wire.h"

#include <algorithm>
#include <cmath>

namespace dismantle::server {

namespace {

Error wrong(const std::string& member, const std::string& expected) {
  return usage("the command was not understood", "'" + member + "' must be " + expected, "see docs/wire.md");
}

}  // namespace

Error usage(const std::string& problem, const std::string& why, const std::string& advice) {
  return {ErrorKind::Usage, problem + " (" + why + "); " + advice};
}

Result<std::vector<ComponentId>> Arguments::components() const {
  Result<std::vector<ComponentId>> ids = list("components");
  if (ids && ids->empty()) return wrong("components", "a list of indices");
  return ids;
}

Result<std::vector<ComponentId>> Arguments::list(const char* name) const {
  std::vector<ComponentId> ids;
  const auto found = command_.find(name);
  if (found == command_.end()) return ids;
  if (!found->is_array()) return wrong(name, "a list of indices");
  for (const Json& one : *found) {
    if (!one.is_number_unsigned() || one.get<std::uint64_t>() >= component_count_)
      return wrong(name, "indices of components of the assembly");
    ids.emplace_back(one.get<std::uint32_t>());
  }
  return ids;
}

Result<ChosenPreferences> Arguments::preferences() const {
  const auto found = command_.find("prefer");
  if (found == command_.end()) return ChosenPreferences{};
  const std::string expected =
      "a list of direction, upright, groups, support, tools, loose, each once at most, as it is or as \"groups=2\"";
  std::vector<std::string> texts;
  if (!found->is_array()) return wrong("prefer", expected);
  for (const Json& one : *found) {
    if (!one.is_string()) return wrong("prefer", expected);
    texts.push_back(one.get<std::string>());
  }
  const std::optional<ChosenPreferences> chosen = read_preferences(texts);
  if (!chosen) return wrong("prefer", expected);
  return *chosen;
}

Result<double> Arguments::effort() const {
  const auto found = command_.find("effort");
  if (found == command_.end()) return 1.0;
  if (!found->is_number() || !(found->get<double>() > 0) || found->get<double>() > kMaxEffort)
    return wrong("effort", "a number above 0 and at most 1000");
  return found->get<double>();
}

Result<std::optional<Vec3>> Arguments::direction() const {
  const auto found = command_.find("direction");
  if (found == command_.end() || found->is_null()) return std::optional<Vec3>{};
  Vec3 v;
  bool is_valid = found->is_array() && found->size() == 3;
  for (int k = 0; is_valid && k < 3; ++k) {
    const Json& one = (*found)[static_cast<std::size_t>(k)];
    is_valid = one.is_number() && std::fabs(one.get<double>()) <= kMaxWireNumber;
    if (is_valid) v[k] = one.get<double>();
  }
  if (!is_valid) return wrong("direction", "three numbers");
  return std::optional<Vec3>{v};
}

Result<double> Arguments::number(const char* name) const {
  const auto found = command_.find(name);
  if (found == command_.end() || !found->is_number() || std::fabs(found->get<double>()) > kMaxWireNumber)
    return wrong(name, "a number");
  return found->get<double>();
}

Result<std::string> Arguments::text(const char* name) const {
  const auto found = command_.find(name);
  if (found == command_.end() || !found->is_string()) return wrong(name, "a string");
  return found->get<std::string>();
}

Result<std::uint64_t> Arguments::index(const char* name) const {
  const auto found = command_.find(name);
  if (found == command_.end() || !found->is_number_unsigned()) return wrong(name, "an index");
  return found->get<std::uint64_t>();
}

Result<PlaybackSource> Arguments::source() const {
  const auto found = command_.find("source");
  if (found == command_.end() || *found == "recording") return PlaybackSource::Recording;
  if (*found == "guide") return PlaybackSource::Guide;
  return wrong("source", "recording or guide");
}

Result<ResponseKind> Arguments::response() const {
  const auto found = command_.find("response");
  for (const ResponseKind kind : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide})
    if (found != command_.end() && *found == std::string(name_of(kind))) return kind;
  return wrong("response", "one of slide, touch, stop");
}

Result<std::string> Arguments::optional_text(const char* name) const {
  const auto found = command_.find(name);
  if (found == command_.end()) return std::string();
  if (!found->is_string() || found->get_ref<const std::string&>().size() > kMaxText)
    return wrong(name, "a string of at most " + std::to_string(kMaxText) + " bytes");
  return found->get<std::string>();
}

Result<std::string> Arguments::choice(const char* name, const std::vector<std::string>& choices) const {
  const auto found = command_.find(name);
  if (found == command_.end()) return choices.front();
  std::string all;
  for (const std::string& one : choices) {
    if (*found == one) return one;
    all += (all.empty() ? "" : ", ") + one;
  }
  return wrong(name, "one of " + all);
}

Result<bool> Arguments::flag(const char* name) const {
  const auto found = command_.find(name);
  if (found == command_.end()) return false;
  if (!found->is_boolean()) return wrong(name, "true or false");
  return found->get<bool>();
}

}  // namespace dismantle::server
