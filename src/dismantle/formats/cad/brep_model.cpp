// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/brep_shape.h"
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/cad/shape_product_tree.h"

namespace dismantle {

Result<CadModel> read_brep_model(const CadSource& source, const ImportOptions& options) {
  const TopoDS_Shape shape = read_brep_shape(source.bytes, options.progress);
  if (shape.IsNull())
    return Error{ErrorKind::Unreadable, "it breaks the grammar of BREP, or holds no shape; export it again"};
  ShapeNames names;
  names.root = source.name();
  Result<CadProductTree> products = walk_shape(shape, names, options);
  if (!products) return products.error();
  return CadModel{std::move(*products), {}, {}};
}

}  // namespace dismantle
