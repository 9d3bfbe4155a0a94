// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/cad/product_tree.h"
#include "dismantle/formats/import/import_options.h"

#include <TDF_Label.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <string>

namespace dismantle {

/// The colours of a label of an XDE document, and of the labels of its sub-shapes.
CadProduct xde_product(const Handle(XCAFDoc_ColorTool) & colors, const TDF_Label& label);

/// Walks the product tree of an XDE document. Each solid of a product is an occurrence; its faces outside solids are
/// one more. Names: of the product, else of the instance, else `root_name`. Errors: Unreadable if there are more
/// occurrences than `limit`, or far more tree nodes than that.
Result<CadProductTree> walk_xde_products(const Handle(TDocStd_Document) & document, const std::string& root_name,
                                         Solids solids, std::size_t limit);

}  // namespace dismantle
