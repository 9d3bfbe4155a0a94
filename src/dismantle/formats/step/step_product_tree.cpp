// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/step/step_product_tree.h"

#include <BRep_Builder.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelMapHasher.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_OrientedShapeMapHasher.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GraphNode.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace dismantle {

namespace {

constexpr int kDeepestTree = 500;              // nodes from the root to a leaf
constexpr std::size_t kNodesPerComponent = 4;  // of the limit: beyond lies a tree made to explode

std::string name_of_label(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  return TCollection_AsciiString(name->Get()).ToCString();  // UTF-8
}

std::optional<Color> color_of_label(const Handle(XCAFDoc_ColorTool) & tool, const TDF_Label& label) {
  Quantity_ColorRGBA color;
  for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
    if (!tool->GetColor(label, type, color)) continue;
    const NCollection_Vec3<float> srgb =
        Quantity_Color::Convert_LinearRGB_To_sRGB(static_cast<NCollection_Vec3<float>>(color.GetRGB()));
    return Color{srgb.r(), srgb.g(), srgb.b(), color.Alpha()};
  }
  return std::nullopt;
}

/// The faces of a shape outside its solids, in one compound; null if there are none.
TopoDS_Shape faces_outside_solids(const TopoDS_Shape& shape) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  bool any = false;
  for (TopExp_Explorer faces(shape, TopAbs_FACE, TopAbs_SOLID); faces.More(); faces.Next()) {
    builder.Add(compound, faces.Current());
    any = true;
  }
  return any ? TopoDS_Shape(compound) : TopoDS_Shape();
}

/// One solid (or the remaining faces) of a product, and its placement in the product.
struct Piece {
  std::uint32_t shape;
  gp_Trsf product_from_shape;
};

struct Leaf {
  std::uint32_t product;
  std::vector<Piece> pieces;
};

/// Properties that a node inherits.
struct Path {
  gp_Trsf placement;
  std::vector<TDF_Label> instances;  // from the root down
  std::optional<Color> inherited_color;
  std::uint32_t parent = 0;
  int depth = 0;
};

class Walker {
 public:
  Walker(const Handle(TDocStd_Document) & document, const std::string& root_name, Solids solids, std::size_t limit)
      : shape_tool_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        color_tool_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        root_name_(root_name),
        solids_(solids),
        limit_(limit) {}

  Result<StepProductTree> walk() {
    TDF_LabelSequence free;
    shape_tool_->GetFreeShapes(free);
    if (free.Length() != 1) result_.tree.push_back({root_name_, 0});
    for (int i = 1; i <= free.Length(); ++i) visit(free.Value(i), {}, Path{});
    if (too_large_ || result_.occurrences.size() > limit_)
      return Error{ErrorKind::Unreadable, "it holds too large an assembly: more than " + std::to_string(limit_) +
                                              " components, or endless nesting; split it into several files"};
    return std::move(result_);
  }

 private:
  /// `label`: a product; `instance`: the label that places it, null for a free one; `path`: of the instance.
  void visit(const TDF_Label& label, const TDF_Label& instance, Path path) {
    if (path.depth > kDeepestTree || result_.tree.size() > kNodesPerComponent * limit_ ||
        result_.occurrences.size() > limit_)
      too_large_ = true;
    if (too_large_) return;

    std::string name = name_of_label(label);
    if (name.empty() && !instance.IsNull()) name = name_of_label(instance);
    if (name.empty()) name = root_name_;
    path.parent = add_node(name, path.parent);

    if (!XCAFDoc_ShapeTool::IsAssembly(label)) return add_leaf(label, name, path);
    if (const auto own = color_of_label(color_tool_, label)) path.inherited_color = own;
    if (const auto own = instance_color(path)) path.inherited_color = own;
    TDF_LabelSequence instances;
    XCAFDoc_ShapeTool::GetComponents(label, instances);
    ++path.depth;
    for (int i = 1; i <= instances.Length(); ++i) visit_instance(instances.Value(i), path);
  }

  void visit_instance(const TDF_Label& instance, const Path& parent) {
    TDF_Label product;
    if (!XCAFDoc_ShapeTool::GetReferredShape(instance, product)) return;
    Path path = parent;
    path.placement = parent.placement * XCAFDoc_ShapeTool::GetLocation(instance).Transformation();
    path.instances.push_back(instance);
    visit(product, instance, std::move(path));
  }

  std::uint32_t add_node(const std::string& name, std::uint32_t parent) {
    result_.tree.push_back({name, parent});
    return static_cast<std::uint32_t>(result_.tree.size() - 1);
  }

  void add_leaf(const TDF_Label& label, const std::string& name, const Path& path) {
    const Leaf& leaf = leaf_of(label);
    for (const Piece& piece : leaf.pieces) {
      StepOccurrence occurrence;
      occurrence.name = name;
      occurrence.shape = piece.shape;
      occurrence.product = leaf.product;
      occurrence.tree_node = leaf.pieces.size() == 1 ? path.parent : add_node(name, path.parent);
      occurrence.placement = path.placement * piece.product_from_shape;
      occurrence.instance_color = instance_color(path);
      occurrence.inherited_color = path.inherited_color;
      result_.occurrences.push_back(std::move(occurrence));
    }
  }

  const Leaf& leaf_of(const TDF_Label& label) {
    if (const Leaf* known = leaves_.Seek(label)) return *known;
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    Leaf leaf;
    leaf.product = static_cast<std::uint32_t>(result_.products.size());
    result_.products.push_back(product_of(label));
    for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next())
      if (TopExp_Explorer(solids.Current(), TopAbs_FACE).More()) leaf.pieces.push_back(piece_of(solids.Current()));
    const TopoDS_Shape rest = faces_outside_solids(shape);
    if (!rest.IsNull()) leaf.pieces.push_back(piece_of(rest));
    if (leaf.pieces.size() > 1 && solids_ == Solids::Join) leaf.pieces = {piece_of(shape)};
    leaves_.Bind(label, leaf);
    return leaves_.Find(label);
  }

  Piece piece_of(const TopoDS_Shape& shape) {
    const TopoDS_Shape here = shape.Located(TopLoc_Location());
    if (!shape_index_.IsBound(here)) {
      shape_index_.Bind(here, static_cast<std::uint32_t>(result_.shapes.size()));
      result_.shapes.push_back(here);
    }
    return {shape_index_.Find(here), shape.Location().Transformation()};
  }

  StepProduct product_of(const TDF_Label& label) {
    StepProduct product;
    product.color = color_of_label(color_tool_, label);
    TDF_LabelSequence subshapes;
    XCAFDoc_ShapeTool::GetSubShapes(label, subshapes);
    for (int i = 1; i <= subshapes.Length(); ++i)
      if (const auto color = color_of_label(color_tool_, subshapes.Value(i)))
        product.subshape_colors.Bind(XCAFDoc_ShapeTool::GetShape(subshapes.Value(i)).Located(TopLoc_Location()),
                                     *color);
    return product;
  }

  /// The colour of the innermost instance of a path, as set by the outermost assembly that sets one.
  std::optional<Color> instance_color(const Path& path) const {
    for (std::size_t first = 0; first + 1 < path.instances.size(); ++first) {
      TDF_LabelSequence usage;
      for (std::size_t i = first; i < path.instances.size(); ++i) usage.Append(path.instances[i]);
      Handle(XCAFDoc_GraphNode) node;
      if (!XCAFDoc_ShapeTool::FindSHUO(usage, node)) continue;
      if (const auto color = color_of_label(color_tool_, node->Label())) return color;
    }
    if (path.instances.empty()) return std::nullopt;
    return color_of_label(color_tool_, path.instances.back());
  }

  Handle(XCAFDoc_ShapeTool) shape_tool_;
  Handle(XCAFDoc_ColorTool) color_tool_;
  std::string root_name_;
  Solids solids_;
  std::size_t limit_;
  bool too_large_ = false;
  StepProductTree result_;
  NCollection_DataMap<TDF_Label, Leaf, TDF_LabelMapHasher> leaves_;
  NCollection_DataMap<TopoDS_Shape, std::uint32_t, TopTools_OrientedShapeMapHasher> shape_index_;
};

}  // namespace

Result<StepProductTree> walk_step_products(const Handle(TDocStd_Document) & document, const std::string& root_name,
                                           Solids solids, std::size_t limit) {
  return Walker(document, root_name, solids, limit).walk();
}

}  // namespace dismantle
