// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <NCollection_DataMap.hxx>
#include <TDocStd_Document.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <cstdint>
#include <gp_Trsf.hxx>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// A product with shapes, and the colours of its label and of the labels of its sub-shapes.
struct StepProduct {
  std::optional<Color> color;
  NCollection_DataMap<TopoDS_Shape, Color, TopTools_ShapeMapHasher> subshape_colors;  ///< Keys: without location.
};

/// One occurrence of a solid (or of a product's shapes without solids) in the assembled state.
struct StepOccurrence {
  std::string name;
  std::uint32_t shape = 0;               ///< Index into StepProductTree::shapes.
  std::uint32_t product = 0;             ///< Index into StepProductTree::products.
  std::uint32_t tree_node = 0;           ///< Index into StepProductTree::tree.
  gp_Trsf placement;                     ///< assembly_from_shape, perhaps with a scale or a mirroring
  std::optional<Color> instance_color;   ///< Of this occurrence: overrides the product's colours.
  std::optional<Color> inherited_color;  ///< Of an enclosing assembly: used if there is no other.
};

/// The product tree of an XDE document.
struct StepProductTree {
  std::vector<TopoDS_Shape> shapes;  ///< Distinct, without location.
  std::vector<StepProduct> products;
  std::vector<StepOccurrence> occurrences;  ///< In the order of the file.
  std::vector<TreeNode> tree;               ///< Node 0 is named `root_name`, or is the only free product.
};

/// Walks the product tree of a document. Each solid of a product is an occurrence; its faces outside solids are one
/// more; with Solids::Join, they are one occurrence together. Names: of the product, else of the instance, else
/// `root_name`. Errors: Unreadable if there are more occurrences than `limit`, or far more tree nodes than that.
Result<StepProductTree> walk_step_products(const Handle(TDocStd_Document) & document, const std::string& root_name,
                                           Solids solids, std::size_t limit);

}  // namespace dismantle
