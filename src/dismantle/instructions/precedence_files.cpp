// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/precedence_files.h"

#include "dismantle/files/json_node.h"

#include <algorithm>

namespace dismantle {

namespace {

std::vector<std::string> names_of(const Assembly& assembly, const std::vector<ComponentId>& components) {
  std::vector<std::string> names;
  names.reserve(components.size());
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  return names;
}

/// Numbers from 1, as people count steps.
std::string numbers_text(const std::vector<std::uint32_t>& steps) {
  std::string text;
  for (const std::uint32_t step : steps) text += (text.empty() ? "" : ", ") + std::to_string(step + 1);
  return "[" + text + "]";
}

/// The steps of one rank, rank by rank.
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

/// The bodies that a plan takes apart, as a tree: what is taken out of each in order, and what is left of it.
std::string body_json(const Assembly& assembly, const Plan& plan, std::uint32_t body) {
  std::vector<ComponentId> left;
  if (body == PlanStep::kWhole) {
    for (std::uint32_t c = 0; c < assembly.components.size(); ++c) left.emplace_back(c);
  } else {
    left = plan.steps[body].components;
  }
  std::string parts;
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    if (step.part_of != body) continue;
    if (!parts.empty()) parts += ", ";
    parts += step.components.size() > 1
                 ? body_json(assembly, plan, k)
                 : "{\"step\": " + std::to_string(k + 1) +
                       ", \"components\": " + json_text(names_of(assembly, step.components)) + "}";
    std::erase_if(left, [&](ComponentId c) {
      return std::find(step.components.begin(), step.components.end(), c) != step.components.end();
    });
  }
  const std::string number = body == PlanStep::kWhole ? "null" : std::to_string(body + 1);
  return "{\"step\": " + number + ", \"parts\": [" + parts + "], \"left\": " + json_text(names_of(assembly, left)) +
         "}";
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
            " [label=" + json_text(std::to_string(k + 1) + "  " + step_text(assembly, plan.steps[k])) + "];\n";
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
  std::string text = "{\n  \"format\": \"dismantle-precedence\", \"version\": 1,\n  \"assembly\": {\"file\": " +
                     json_text(assembly.source_file) + ", \"sha256\": " + json_text(assembly.source_sha256) +
                     "},\n  \"steps\": [";
  for (std::uint32_t k = 0; k < plan.steps.size(); ++k) {
    const PlanStep& step = plan.steps[k];
    text += std::string(k == 0 ? "" : ",") + "\n    {\"step\": " + std::to_string(k + 1) +
            ", \"components\": " + json_text(names_of(assembly, step.components)) +
            ", \"part_of_step\": " + (step.part_of == PlanStep::kWhole ? "null" : std::to_string(step.part_of + 1)) +
            ", \"rank\": " + std::to_string(graph.ranks[k]) + ", \"before\": " + numbers_text(graph.before[k]) + "}";
  }
  text += "\n  ],\n  \"ranks\": [";
  for (const std::vector<std::uint32_t>& rank : steps_by_rank(graph))
    text += (text.back() == '[' ? "" : ", ") + numbers_text(rank);
  return text + "],\n  \"subassemblies\": " + body_json(assembly, plan, PlanStep::kWhole) + "\n}\n";
}

}  // namespace dismantle
