// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/viewer_model.h"

#include "dismantle/files/json_node.h"

namespace dismantle {

namespace {

std::string point_text(const Vec3& v) {
  return "[" + json_text(v.x) + ", " + json_text(v.y) + ", " + json_text(v.z) + "]";
}

std::string box_text(const Aabb& box) {
  return "[" + point_text(box.empty() ? Vec3{} : box.lower) + ", " + point_text(box.empty() ? Vec3{} : box.upper) + "]";
}

}  // namespace

std::string viewer_model_json(const Assembly& assembly, double tolerance) {
  std::string text =
      "{\"name\": " + json_text(assembly.source_file) + ", \"sha256\": " + json_text(assembly.source_sha256) +
      ", \"units\": " + json_text(assembly.source_units) + ", \"deflection\": " + json_text(assembly.deflection) +
      ", \"tolerance\": " + json_text(tolerance) + ", \"triangles\": " + std::to_string(triangle_count(assembly)) +
      ", \"bounds\": " + box_text(assembled_bounds(assembly)) + ",\n\"tree\": [";
  for (const TreeNode& node : assembly.tree) {
    if (&node != assembly.tree.data()) text += ",\n";
    text += "{\"name\": " + json_text(node.name) + ", \"parent\": " + std::to_string(node.parent) + "}";
  }
  text += "],\n\"components\": [";
  for (const Component& c : assembly.components) {
    if (&c != assembly.components.data()) text += ",\n";
    text += "{\"name\": " + json_text(c.name) + ", \"node\": " + std::to_string(c.tree_node) +
            ", \"triangles\": " + std::to_string(c.mesh->faces.size()) +
            ", \"bounds\": " + box_text(assembled_bounds(c)) + "}";
  }
  return text + "]}";
}

}  // namespace dismantle
