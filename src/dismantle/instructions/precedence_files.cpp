// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/precedence_files.h"

#include "dismantle/files/json_text.h"

#include <algorithm>

namespace dismantle {

namespace {

std::vector<std::string> names_of(const Assembly& assembly, const std::vector<ComponentId>& components) {
  std::vector<std::string> names;
  names.reserve(components.size());
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  return names;
}

/// Step numbers, counted from 1.
JsonValue step_numbers(const std::vector<std::uint32_t>& steps) {
  JsonValue numbers = JsonValue::array();
  for (const std::uint32_t step : steps) numbers.push_back(step + 1);
  return numbers;
}

/// The steps grouped by rank.
std::vector<std::vector<std::uint32_t>> steps_by_rank(const PrecedenceGraph& graph) {
  std::vector<std::vector<std::uint32_t>> by_rank;
  for (std::uint32_t k = 0; k < graph.ranks.size(); ++k) {
    if (by_rank.size() <= graph.ranks[k]) by_rank.resize(graph.ranks[k] + 1);
    by_rank[graph.ranks[k]].push_back(k);
  }
  return by_rank;
}

std::string node_text(std::uint32_t step) {
  return "s" + std::to_string(step + 1);
}

/// The tree of bodies that a plan disassembles: the parts removed from each, in order, and the components left of it.
JsonValue body_json(const Assembly& assembly, const Plan& plan, std::uint32_t body) {
  std::vector<ComponentId> left;
  if (body == PlanStep::kWhole) {
    for (std::uint32_t c = 0; c < assembly.components.size(); ++c) left.emplace_back(c);
  } else {
    left = plan.steps[body].components;
  }
  JsonValue parts = JsonValue::array();
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    if (step.part_of != body) continue;
    parts.push_back(step.components.size() > 1
                        ? body_json(assembly, plan, k)
                        : JsonValue{{"step", k + 1}, {"components", names_of(assembly, step.components)}});
    std::erase_if(left, [&](ComponentId c) {
      return std::find(step.components.begin(), step.components.end(), c) != step.components.end();
    });
  }
  return {{"step", body == PlanStep::kWhole ? JsonValue() : JsonValue(body + 1)},
          {"parts", std::move(parts)},
          {"left", names_of(assembly, left)}};
}

}  // namespace

std::string step_text(const Assembly& assembly, const PlanStep& step) {
  std::string text = assembly[step.components.front()].name;
  if (step.components.size() > 1) text += " and " + std::to_string(step.components.size() - 1) + " more";
  return text;
}

std::string precedence_dot(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph) {
  std::string text = "digraph precedence {\n  rankdir=LR;\n  node [shape=box];\n";
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k)
    text += "  " + node_text(k) +
            " [label=" + json_line(std::to_string(k + 1) + "  " + step_text(assembly, plan.steps[k])) + "];\n";
  for (const std::vector<std::uint32_t>& rank : steps_by_rank(graph)) {
    text += "  { rank=same;";
    for (const std::uint32_t k : rank) text += " " + node_text(k) + ";";
    text += " }\n";
  }
  for (std::uint32_t k = 0; k < graph.before.size(); ++k)
    for (const std::uint32_t j : graph.before[k])
      text +=
          "  " + node_text(j) + " -> " + node_text(k) + (plan.steps[k].part_of == j ? " [style=dashed]" : "") + ";\n";
  return text + "}\n";
}

std::string precedence_json(const Assembly& assembly, const Plan& plan, const PrecedenceGraph& graph) {
  std::vector<std::string> steps;
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    steps.push_back(
        json_line({{"step", k + 1},
                   {"components", names_of(assembly, step.components)},
                   {"part_of_step", step.part_of == PlanStep::kWhole ? JsonValue() : JsonValue(step.part_of + 1)},
                   {"rank", graph.ranks[k]},
                   {"before", step_numbers(graph.before[k])}}));
  }
  JsonValue ranks = JsonValue::array();
  for (const std::vector<std::uint32_t>& rank : steps_by_rank(graph)) ranks.push_back(step_numbers(rank));
  const JsonValue about{{"file", assembly.source_file}, {"sha256", assembly.source_sha256}};
  return "{\n  \"format\": \"dismantle-precedence\", \"version\": 1,\n  \"assembly\": " + json_line(about) +
         ",\n  \"steps\": [" + json_lines(steps, 4) + "\n  ],\n  \"ranks\": " + json_line(ranks) +
         ",\n  \"subassemblies\": " + json_line(body_json(assembly, plan, PlanStep::kWhole)) + "\n}\n";
}

}  // namespace dismantle
