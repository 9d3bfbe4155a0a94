// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/fasteners/find_fasteners.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// A line of a bill of materials: components of equal shape and colour.
struct BillItem {
  std::string name;                     ///< Of the first of them, without the suffix "#2" that made it unique.
  std::vector<ComponentId> components;  ///< In ascending order.
  std::vector<std::string> places;      ///< Path of each in the product tree: "vice/jaw/screw".
  Vec3 size;                            ///< Of the box around the shape, along the axes of its own frame [mm].
  std::optional<double> volume;         ///< [mm^3]; none if the surface is not closed.
  double area = 0;                      ///< [mm^2]
  std::size_t triangles = 0;            ///< Of one component.
  Color color;                          ///< Of all of them.
  std::optional<Fastener> fastener;     ///< Of the first of them that is recognised as one.
};

/// The bill of materials of an assembly. Shapes are equal as first_of_shape() finds them. Ordered by the first
/// component of each line.
std::vector<BillItem> bill_of_materials(const Assembly& assembly);
/// The same with fasteners that are known. @param fasteners what find_fasteners() returns
std::vector<BillItem> bill_of_materials(const Assembly& assembly,
                                        const std::vector<std::optional<Fastener>>& fasteners);

/// The line of the bill of materials, from 0, that each component is in. Shape [component_count].
std::vector<std::size_t> bill_lines(const Assembly& assembly);

/// The bill as CSV (RFC 4180) with a header; the columns are in docs/formats.md.
std::string bill_csv(const Assembly& assembly, const std::vector<BillItem>& bill);

/// The bill as JSON: docs/formats.md, "Bill of materials".
std::string bill_json(const Assembly& assembly, const std::vector<BillItem>& bill);

}  // namespace dismantle
