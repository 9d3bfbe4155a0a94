// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/bill_of_materials.h"

#include "dismantle/documents/fastener_json.h"
#include "dismantle/files/csv_text.h"
#include "dismantle/files/json_text.h"
#include "dismantle/surface/equal_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace dismantle {

namespace {

/// The name without the suffix that make_names_unique adds.
std::string name_without_count(const std::string& name) {
  const std::size_t mark = name.rfind('#');
  const bool counted = mark != std::string::npos && mark > 0 && mark + 1 < name.size() &&
                       name.find_first_not_of("0123456789", mark + 1) == std::string::npos;
  return counted ? name.substr(0, mark) : name;
}

std::string place_of(const Assembly& assembly, const Component& c) {
  if (assembly.tree.empty()) return c.name;
  std::vector<std::string> names;
  for (std::uint32_t node = c.tree_node; node != 0; node = assembly.tree[node].parent)
    names.push_back(assembly.tree[node].name);
  std::reverse(names.begin(), names.end());
  if (names.empty() || names.back() != name_without_count(c.name)) names.push_back(c.name);
  return joined(names, "/");
}

double area_of(const TriangleMesh& mesh) {
  double twice = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) twice += length(normal_unscaled(mesh.triangle(i)));
  return twice / 2;
}

BillItem new_item(const Component& c) {
  BillItem item;
  item.name = name_without_count(c.name);
  const Aabb box = bounds(*c.mesh);
  if (!box.empty()) item.size = box.size();
  if (c.faults.closed()) item.volume = std::abs(signed_volume(*c.mesh));
  item.area = area_of(*c.mesh);
  item.triangles = c.mesh->faces.size();
  item.color = c.color;
  return item;
}

/// "#aabbcc", or "#aabbccdd" with alpha if it is not opaque.
std::string color_text(const Color& color) {
  const auto part = [](float value) { return static_cast<int>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); };
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(color.r), part(color.g), part(color.b));
  if (part(color.a) < 255) std::snprintf(text + 7, sizeof text - 7, "%02x", part(color.a));
  return text;
}

/// A text about the fastener of an item as a field; empty if it is none.
std::string of_fastener(const BillItem& item, std::string (*text)(const Fastener&)) {
  return item.fastener ? csv_field(text(*item.fastener)) : std::string();
}

std::vector<std::string> component_names(const Assembly& assembly, const BillItem& item) {
  std::vector<std::string> names;
  for (const ComponentId c : item.components) names.push_back(assembly[c].name);
  return names;
}

}  // namespace

std::vector<std::size_t> bill_lines(const Assembly& assembly) {
  const std::vector<ComponentId> firsts = first_of_shape(assembly);
  std::map<std::pair<ComponentId, std::array<float, 4>>, std::size_t> numbers;  // by shape and colour
  std::vector<std::size_t> lines;
  lines.reserve(firsts.size());
  for (std::size_t c = 0; c < firsts.size(); ++c) {
    const Color& color = assembly.components[c].color;
    const std::size_t next = numbers.size();
    lines.push_back(numbers.try_emplace({firsts[c], {color.r, color.g, color.b, color.a}}, next).first->second);
  }
  return lines;
}

std::vector<BillItem> bill_of_materials(const Assembly& assembly) {
  return bill_of_materials(assembly, find_fasteners(assembly));
}

std::vector<BillItem> bill_of_materials(const Assembly& assembly,
                                        const std::vector<std::optional<Fastener>>& fasteners) {
  std::vector<BillItem> bill;
  const std::vector<std::size_t> lines = bill_lines(assembly);
  for (std::uint32_t c = 0; c < lines.size(); ++c) {
    const Component& component = assembly.components[c];
    if (lines[c] == bill.size()) bill.push_back(new_item(component));
    BillItem& item = bill[lines[c]];
    item.components.push_back(ComponentId(c));
    item.places.push_back(place_of(assembly, component));
    if (!item.fastener) item.fastener = fasteners[c];
  }
  return bill;
}

std::string bill_csv(const Assembly& assembly, const std::vector<BillItem>& bill) {
  std::string text = csv_row({"item", "name", "count", "fastener", "designation", "tool", "size_x_mm", "size_y_mm",
                              "size_z_mm", "volume_mm3", "area_mm2", "triangles", "color", "components", "places"});
  for (std::size_t i = 0; i < bill.size(); ++i) {
    const BillItem& item = bill[i];
    text += csv_row({csv_field(i + 1), csv_field(item.name), csv_field(item.components.size()),
                     of_fastener(item, kind_text), of_fastener(item, designation_text), of_fastener(item, tool_text),
                     csv_field(item.size.x), csv_field(item.size.y), csv_field(item.size.z),
                     item.volume ? csv_field(*item.volume) : std::string(), csv_field(item.area),
                     csv_field(item.triangles), color_text(item.color),
                     csv_field(joined(component_names(assembly, item))), csv_field(joined(item.places))});
  }
  return text;
}

std::string bill_json(const Assembly& assembly, const std::vector<BillItem>& bill) {
  std::vector<std::string> items;
  for (const BillItem& item : bill) {
    const std::string values = json_line({{"name", item.name},
                                          {"count", item.components.size()},
                                          {"fastener", item.fastener ? fastener_json(*item.fastener) : JsonValue()},
                                          {"size_mm", {item.size.x, item.size.y, item.size.z}},
                                          {"volume_mm3", item.volume ? JsonValue(*item.volume) : JsonValue()},
                                          {"area_mm2", item.area},
                                          {"triangles", item.triangles},
                                          {"color", color_text(item.color)}});
    items.push_back(values.substr(0, values.size() - 1) + ",\n     \"components\": " +
                    json_line(component_names(assembly, item)) + ",\n     \"places\": " + json_line(item.places) + "}");
  }
  const JsonValue about{
      {"file", assembly.source_file}, {"sha256", assembly.source_sha256}, {"components", assembly.components.size()}};
  return "{\n  \"format\": \"dismantle-bill\", \"version\": 1,\n  \"assembly\": " + json_line(about) +
         ",\n  \"items\": [" + json_lines(items, 4) + "\n  ]\n}\n";
}

}  // namespace dismantle
