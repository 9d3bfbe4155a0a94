// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/cad/product_tree.h"
#include "dismantle/formats/import/import_options.h"

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>

namespace dismantle {

/// What is known about the shapes of a file that has no products.
struct ShapeNames {
  std::string root;  ///< For shapes without a name of their own or of a compound around them.
  /// The name of a compound, without its location; empty if it has none.
  std::function<std::string(const TopoDS_Shape&)> name_of;
  /// The shape and the colours of the product that a compound is to become.
  std::function<TopoDS_Shape(const TopoDS_Shape&, CadProduct&)> product_of;
};

/// The compounds of a shape as a product tree: a compound that holds compounds is a node, any other one a product; what
/// else a node holds is one more. Each solid of a product is an occurrence, each shell outside solids, and the other
/// faces together. Errors: Unreadable if there are more occurrences than the limit, or far more tree nodes than that.
Result<CadProductTree> walk_shape(const TopoDS_Shape& shape, const ShapeNames& names, const ImportOptions& options);

}  // namespace dismantle
