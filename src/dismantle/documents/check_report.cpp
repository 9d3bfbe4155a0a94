// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/check_report.h"

#include "dismantle/files/json_text.h"
#include "dismantle/files/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace dismantle {

namespace {

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Depths that differ by less than this part of the tolerance are not told apart.
constexpr double kDepthAccuracy = 0.1;
/// Lengths and volumes are estimates: no digits below this [mm], [mm3], and so many digits of a volume.
constexpr double kMinLength = 1e-6, kMinVolume = 1e-6;
constexpr int kVolumeDigits = 3;

/// A length [mm]: four digits, none below what the tolerance tells apart.
std::string length_text(double length, double tolerance) {
  return number_text(length, 4, std::max(kMinLength, kDepthAccuracy * tolerance));
}

/// A point to the hundredth of a millimetre, as far as a table needs it.
std::string place_text(Vec3 p) {
  std::string text;
  for (int k = 0; k < 3; ++k) text += (k > 0 ? " " : "") + formatted("%.2f", std::abs(p[k]) < 0.005 ? 0 : p[k]);
  return text;
}

/// The name of one component of a pair, and whether it is inside the other one.
std::string name_in_table(const Assembly& assembly, const Clash& clash, ComponentId id) {
  return assembly[id].name + (clash.contained == id ? " (inside)" : "");
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

ClashCounts count_clashes(const Clashes& clashes) {
  ClashCounts counts;
  for (const Clash& c : clashes.pairs) {
    counts.near += c.state == ClashState::Near ? 1 : 0;
    counts.contact += c.state == ClashState::Contact ? 1 : 0;
    counts.overlapping += c.state == ClashState::Overlapping ? 1 : 0;
    counts.contained += c.contained.valid() ? 1 : 0;
  }
  return counts;
}

std::vector<Clash> worst_first(const Clashes& clashes) {
  std::vector<Clash> pairs = clashes.pairs;
  std::stable_sort(pairs.begin(), pairs.end(), [](const Clash& a, const Clash& b) {
    return std::tuple(b.state, b.depth, a.distance) < std::tuple(a.state, a.depth, b.distance);
  });
  return pairs;
}

std::string_view explanation_of(ClashState state) {
  switch (state) {
    case ClashState::Near:
      return "apart, but closer than the clearance asked for";
    case ClashState::Contact:
      return "touching, or deeper in each other by no more than the tolerance";
    case ClashState::Overlapping:
      return "deeper in each other than the tolerance: a press fit, a tessellated bore, a simplified thread, or an "
             "error";
  }
  return "";
}

std::string depth_text(const Clash& clash, double tolerance) {
  if (clash.depth <= kDepthAccuracy * tolerance) return "0";
  return (clash.depth_loose ? "up to " : "") + length_text(clash.depth, tolerance);
}

std::string check_report_json(const Assembly& assembly, const Clashes& clashes) {
  const JsonValue about{{"file", assembly.source_file},
                        {"components", assembly.components.size()},
                        {"triangles", triangle_count(assembly)}};
  std::vector<std::string> pairs;
  for (const Clash& c : clashes.pairs) {
    JsonValue pair{{"a", assembly[c.a].name}, {"b", assembly[c.b].name}, {"state", name_of(c.state)}};
    if (c.contained.valid()) pair["contained"] = true;
    pair["distance_mm"] = c.distance;
    pair["depth_mm"] = c.depth;
    if (c.depth_loose) pair["depth_at_least_mm"] = c.depth_attained;
    pair["deepest_at"] = {c.deepest_at.x, c.deepest_at.y, c.deepest_at.z};
    pair["volume_mm3"] = c.volume;
    pairs.push_back(json_line(pair));
  }
  return "{\n  \"format\": \"dismantle-check\", \"version\": 2,\n  \"assembly\": " + json_line(about) +
         ",\n  \"tolerance_mm\": " + json_line(clashes.tolerance) + ",\n  \"pairs\": [" + json_lines(pairs, 4) +
         "\n  ]\n}\n";
}

std::string check_report_text(const Assembly& assembly, const Clashes& clashes) {
  const ClashCounts counts = count_clashes(clashes);
  std::string text = assembly.source_file + ": " + std::to_string(assembly.components.size()) + " components, " +
                     std::to_string(triangle_count(assembly)) + " triangles, tolerance " +
                     number_text(clashes.tolerance, 4) + " mm\n";
  text += std::to_string(counts.overlapping) + " overlapping, ";
  if (counts.contained > 0) text += std::to_string(counts.contained) + " of them one inside the other, ";
  text += std::to_string(counts.contact) + " contact, " + std::to_string(counts.near) + " near\n";
  if (clashes.pairs.empty()) return text;

  std::vector<std::vector<std::string>> rows{
      {"state", "depth mm", "deepest at", "volume mm3", "distance mm", "a", "b"}};
  for (const Clash& c : worst_first(clashes))
    rows.push_back({std::string(name_of(c.state)), depth_text(c, clashes.tolerance), place_text(c.deepest_at),
                    number_text(c.volume, kVolumeDigits, kMinVolume), length_text(c.distance, clashes.tolerance),
                    name_in_table(assembly, c, c.a), name_in_table(assembly, c, c.b)});
  text += "\n" + table_text(rows) + "\n";
  for (const ClashState state : {ClashState::Overlapping, ClashState::Contact, ClashState::Near})
    text += std::string(name_of(state)) + ": " + std::string(explanation_of(state)) + "\n";
  return text + "depth: the greatest distance from a point of either surface inside the other to that surface\n";
}

}  // namespace dismantle
