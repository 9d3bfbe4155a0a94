// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// A line of a bill of materials: components of one shape and colour.
struct BillItem {
  std::string name;                     ///< Of the first of them, without the "#2" that made it unique.
  std::vector<ComponentId> components;  ///< In their order.
  std::vector<std::string> places;      ///< Where each of them is in the product tree: "vice/jaw/screw".
  Vec3 size;                            ///< Of the box around the shape, along the axes of its own frame [mm].
  std::optional<double> volume;         ///< [mm^3]; none where the surface is not closed.
  double area = 0;                      ///< [mm^2]
  std::size_t triangles = 0;
  Color color;
};

/// What an assembly is made of. Components are of one shape where their meshes are equal, number by number: the
/// instances of a product, or equal files. Ordered by the first component of each line.
std::vector<BillItem> bill_of_materials(const Assembly& assembly);

/// As CSV (RFC 4180), a line each with a header; the columns are in docs/formats.md.
std::string bill_csv(const Assembly& assembly, const std::vector<BillItem>& bill);

/// As JSON: docs/formats.md, "Bill of materials".
std::string bill_json(const Assembly& assembly, const std::vector<BillItem>& bill);

}  // namespace dismantle
