// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/shape_product_tree.h"

#include <BRep_Builder.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <utility>

namespace dismantle {

namespace {

constexpr int kDeepestTree = 500;  // compounds from the root to a leaf

/// The shapes directly in a compound.
struct Contents {
  std::vector<TopoDS_Shape> compounds;
  TopoDS_Compound others;
};

Contents contents_of(const TopoDS_Shape& compound) {
  Contents contents;
  const BRep_Builder builder;
  builder.MakeCompound(contents.others);
  for (TopoDS_Iterator child(compound); child.More(); child.Next()) {
    if (child.Value().ShapeType() == TopAbs_COMPOUND) {
      contents.compounds.push_back(child.Value());
    } else {
      builder.Add(contents.others, child.Value());
    }
  }
  return contents;
}

class ShapeWalker {
 public:
  ShapeWalker(const ShapeNames& names, const ImportOptions& options)
      : names_(names), tree_(options.solids, LooseFaces::ByShell, options.limits.components) {}

  Result<CadProductTree> walk(const TopoDS_Shape& shape) {
    visit(shape, {names_.root, gp_Trsf(), 0, 0});
    return tree_.finish();
  }

 private:
  struct Place {
    std::string name;  // of what is around it
    gp_Trsf placement;
    std::uint32_t parent = 0;
    int depth = 0;
  };

  void visit(const TopoDS_Shape& located, Place place) {
    if (place.depth > kDeepestTree) tree_.refuse();
    if (tree_.is_too_large()) return;
    const TopoDS_Shape shape = located.Located(TopLoc_Location());
    place.placement = place.placement * located.Location().Transformation();
    const std::string own = names_.name_of ? names_.name_of(shape) : std::string();
    if (!own.empty()) place.name = own;
    place.parent = tree_.add_node(place.name, place.parent);
    ++place.depth;

    if (shape.ShapeType() != TopAbs_COMPOUND) return add_product(shape, place);
    const Contents contents = contents_of(shape);
    if (contents.compounds.empty()) return add_product(shape, place);
    for (const TopoDS_Shape& compound : contents.compounds) visit(compound, place);
    add_product(contents.others, place);
  }

  void add_product(const TopoDS_Shape& shape, const Place& place) {
    if (!products_.IsBound(shape)) {
      CadProduct product;
      const TopoDS_Shape whole = names_.product_of ? names_.product_of(shape, product) : shape;
      products_.Bind(shape, tree_.add_product(whole, std::move(product)));
    }
    CadOccurrence occurrence;
    occurrence.name = place.name;
    occurrence.product = products_.Find(shape);
    occurrence.tree_node = place.parent;
    occurrence.placement = place.placement;
    tree_.add_occurrences(occurrence);
  }

  const ShapeNames& names_;
  ProductTreeBuilder tree_;
  NCollection_DataMap<TopoDS_Shape, std::uint32_t, TopTools_OrientedShapeMapHasher> products_;
};

}  // namespace

Result<CadProductTree> walk_shape(const TopoDS_Shape& shape, const ShapeNames& names, const ImportOptions& options) {
  return ShapeWalker(names, options).walk(shape);
}

}  // namespace dismantle
