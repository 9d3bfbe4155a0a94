// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/product_tree.h"

#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <utility>

namespace dismantle {

namespace {

constexpr std::size_t kNodesPerComponent = 4;  // of the limit: beyond lies a tree made to explode

/// The faces of a shape that are not in shapes of kind `outside_of`, in one compound; null if there are none.
TopoDS_Shape loose_faces(const TopoDS_Shape& shape, TopAbs_ShapeEnum outside_of) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  bool any = false;
  for (TopExp_Explorer faces(shape, TopAbs_FACE, outside_of); faces.More(); faces.Next()) {
    builder.Add(compound, faces.Current());
    any = true;
  }
  return any ? TopoDS_Shape(compound) : TopoDS_Shape();
}

bool has_faces(const TopoDS_Shape& shape) {
  return TopExp_Explorer(shape, TopAbs_FACE).More();
}

std::vector<TopoDS_Shape> pieces_of(const TopoDS_Shape& shape, LooseFaces loose) {
  std::vector<TopoDS_Shape> pieces;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next())
    if (has_faces(solids.Current())) pieces.push_back(solids.Current());
  if (loose == LooseFaces::ByShell)
    for (TopExp_Explorer shells(shape, TopAbs_SHELL, TopAbs_SOLID); shells.More(); shells.Next())
      if (has_faces(shells.Current())) pieces.push_back(shells.Current());
  const TopoDS_Shape rest = loose_faces(shape, loose == LooseFaces::ByShell ? TopAbs_SHELL : TopAbs_SOLID);
  if (!rest.IsNull()) pieces.push_back(rest);
  return pieces;
}

}  // namespace

std::uint32_t ProductTreeBuilder::add_node(const std::string& name, std::uint32_t parent) {
  result_.tree.push_back({name, parent});
  if (result_.tree.size() > kNodesPerComponent * limit_) too_large_ = true;
  return static_cast<std::uint32_t>(result_.tree.size() - 1);
}

std::uint32_t ProductTreeBuilder::add_product(const TopoDS_Shape& shape, CadProduct product) {
  std::vector<TopoDS_Shape> shapes = pieces_of(shape, loose_faces_);
  if (shapes.size() > 1 && solids_ == Solids::Join) shapes = {shape};
  std::vector<Piece> pieces;
  pieces.reserve(shapes.size());
  for (const TopoDS_Shape& piece : shapes) pieces.push_back(piece_of(piece));
  pieces_.push_back(std::move(pieces));
  result_.products.push_back(std::move(product));
  return static_cast<std::uint32_t>(result_.products.size() - 1);
}

void ProductTreeBuilder::add_occurrences(const CadOccurrence& whole) {
  const std::vector<Piece>& pieces = pieces_[whole.product];
  for (const Piece& piece : pieces) {
    if (too_large_) return;
    CadOccurrence occurrence = whole;
    occurrence.shape = piece.shape;
    if (pieces.size() > 1) occurrence.tree_node = add_node(whole.name, whole.tree_node);
    occurrence.placement = whole.placement * piece.product_from_shape;
    result_.occurrences.push_back(std::move(occurrence));
    if (result_.occurrences.size() > limit_) too_large_ = true;
  }
}

Result<CadProductTree> ProductTreeBuilder::finish() {
  if (too_large_)
    return Error{ErrorKind::Unreadable, "it holds too large an assembly: more than " + std::to_string(limit_) +
                                            " components, or endless nesting; split it into several files"};
  return std::move(result_);
}

ProductTreeBuilder::Piece ProductTreeBuilder::piece_of(const TopoDS_Shape& shape) {
  const TopoDS_Shape here = shape.Located(TopLoc_Location());
  if (!shape_index_.IsBound(here)) {
    shape_index_.Bind(here, static_cast<std::uint32_t>(result_.shapes.size()));
    result_.shapes.push_back(here);
  }
  return {shape_index_.Find(here), shape.Location().Transformation()};
}

}  // namespace dismantle
