// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/scene_assembly.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// A reference to an object, and where it is placed.
struct ThreeMfUse {
  std::string part;          ///< Name of the model part that has the object; empty: the one of the reference.
  std::int64_t object = 0;   ///< Its id in that part.
  SceneTransform placement;  ///< From the object to what refers to it.
};

/// An object of a model part: a mesh, or other objects.
struct ThreeMfObject {
  std::string name;                    ///< Empty if the file gives none.
  SceneMesh mesh;                      ///< In the file's units; every index is below the vertex count.
  std::vector<ThreeMfUse> components;  ///< The objects that it is made of.
  bool is_support = false;             ///< Helps a printer, and is no part of the product.
};

/// One model part of a 3MF package, as declared: references are not checked.
struct ThreeMfModel {
  std::string units = "mm";                                 ///< As millimetres_per_unit knows them.
  std::unordered_map<std::int64_t, ThreeMfObject> objects;  ///< By id.
  std::vector<ThreeMfUse> items;                            ///< What is built.
};

/// Parses the XML of a model part. Errors: Unreadable if it is no 3MF model, an index of a triangle is out of range, a
/// number is not finite, or there are more than `triangle_limit` triangles.
Result<ThreeMfModel> parse_3mf_model(const MeshSource& source, std::size_t triangle_limit);

}  // namespace dismantle
