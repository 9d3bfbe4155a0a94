// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/viewer_model.h"

#include "dismantle/files/json_text.h"
#include "dismantle/surface/equal_shapes.h"

namespace dismantle {

namespace {

JsonValue point_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

JsonValue box_json(const Aabb& box) {
  return {point_json(box.empty() ? Vec3{} : box.lower), point_json(box.empty() ? Vec3{} : box.upper)};
}

}  // namespace

std::string viewer_model_json(const Assembly& assembly, double tolerance) {
  JsonValue model{{"name", assembly.source_file},
                  {"sha256", assembly.source_sha256},
                  {"units", assembly.source_units},
                  {"deflection", assembly.deflection},
                  {"tolerance", tolerance},
                  {"triangles", triangle_count(assembly)},
                  {"bounds", box_json(assembled_bounds(assembly))},
                  {"tree", JsonValue::array()},
                  {"components", JsonValue::array()}};
  for (const TreeNode& node : assembly.tree) model["tree"].push_back({{"name", node.name}, {"parent", node.parent}});
  const std::vector<ComponentId> shapes = first_of_shape(assembly);
  for (std::size_t i = 0; i < assembly.components.size(); ++i) {
    const Component& c = assembly.components[i];
    model["components"].push_back({{"name", c.name},
                                   {"node", c.tree_node},
                                   {"shape", shapes[i].value},
                                   {"triangles", c.mesh->faces.size()},
                                   {"bounds", box_json(assembled_bounds(c))}});
  }
  return json_line(model);
}

}  // namespace dismantle
