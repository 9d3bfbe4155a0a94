// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/check_report.h"

#include "dismantle/files/json_text.h"

#include <algorithm>
#include <cstdio>
#include <tuple>

namespace dismantle {

namespace {

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A length with four digits; "0" for zero.
std::string millimetres(double length) {
  return length == 0 ? "0" : formatted("%.4g", length);
}

/// Appends `text` in a column of that many characters (of UTF-8).
void append_column(std::string& line, std::string_view text, std::size_t width) {
  const auto characters = static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  line += text;
  line.append(width > characters ? width - characters : 0, ' ');
}

/// Rows of equal length as an aligned text table.
std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k + 1 < row.size(); ++k) append_column(line, row[k], widths[k] + 2);
    text += line + row.back() + "\n";
  }
  return text;
}

}  // namespace

PairCounts count_pairs(const PairStates& states) {
  PairCounts counts;
  for (const ComponentPair& p : states.pairs) {
    counts.near += p.state == PairState::Near ? 1 : 0;
    counts.contact += p.state == PairState::Contact ? 1 : 0;
    counts.fit += p.state == PairState::Fit ? 1 : 0;
    counts.embedded += p.state == PairState::Embedded ? 1 : 0;
  }
  return counts;
}

std::vector<ComponentPair> worst_first(const PairStates& states) {
  std::vector<ComponentPair> pairs = states.pairs;
  std::stable_sort(pairs.begin(), pairs.end(), [](const ComponentPair& a, const ComponentPair& b) {
    return std::tuple(b.state, b.penetration, a.distance) < std::tuple(a.state, a.penetration, b.distance);
  });
  return pairs;
}

std::string_view explanation_of(PairState state) {
  switch (state) {
    case PairState::Clear:
      return "apart";
    case PairState::Near:
      return "apart, but closer than the clearance asked for";
    case PairState::Contact:
      return "touching, or overlapping by no more than the tolerance";
    case PairState::Fit:
      return "overlapping a little: a press fit, a tessellated bore, a modelled thread";
    case PairState::Embedded:
      return "overlapping deeply: free to move until apart";
  }
  return "";
}

std::string check_report_json(const Assembly& assembly, const PairStates& states) {
  const JsonValue about{{"file", assembly.source_file},
                        {"components", assembly.components.size()},
                        {"triangles", triangle_count(assembly)}};
  std::vector<std::string> pairs;
  for (const ComponentPair& p : states.pairs) {
    if (p.state == PairState::Clear) continue;
    pairs.push_back(json_line({{"a", assembly[p.a].name},
                               {"b", assembly[p.b].name},
                               {"state", name_of(p.state)},
                               {"distance_mm", p.distance},
                               {"penetration_mm", p.penetration},
                               {"triangle_pairs", p.triangle_pairs}}));
  }
  return "{\n  \"format\": \"dismantle-check\", \"version\": 1,\n  \"assembly\": " + json_line(about) +
         ",\n  \"tolerance_mm\": " + json_line(states.tolerance) + ",\n  \"pairs\": [" + json_lines(pairs, 4) +
         "\n  ]\n}\n";
}

std::string check_report_text(const Assembly& assembly, const PairStates& states) {
  const PairCounts counts = count_pairs(states);
  std::string text = assembly.source_file + ": " + std::to_string(assembly.components.size()) + " components, " +
                     std::to_string(triangle_count(assembly)) + " triangles, tolerance " +
                     millimetres(states.tolerance) + " mm\n";
  text += std::to_string(counts.embedded) + " embedded, " + std::to_string(counts.fit) + " fit, " +
          std::to_string(counts.contact) + " contact, " + std::to_string(counts.near) + " near\n";
  if (states.pairs.empty()) return text;

  std::vector<std::vector<std::string>> rows{
      {"state", "depth mm", "allowed mm", "distance mm", "triangle pairs", "a", "b"}};
  for (const ComponentPair& p : worst_first(states)) {
    const bool free = p.state == PairState::Embedded;
    rows.push_back({std::string(name_of(p.state)), millimetres(p.penetration),
                    free ? "free" : millimetres(p.allowed_penetration), millimetres(p.distance),
                    std::to_string(p.triangle_pairs), assembly[p.a].name, assembly[p.b].name});
  }
  text += "\n" + table_text(rows) + "\n";
  for (const PairState state : {PairState::Embedded, PairState::Fit, PairState::Contact, PairState::Near})
    text += std::string(name_of(state)) + ": " + std::string(explanation_of(state)) + "\n";
  return text + "Features of a component that are thinner than the allowed depth are not protected.\n";
}

}  // namespace dismantle
