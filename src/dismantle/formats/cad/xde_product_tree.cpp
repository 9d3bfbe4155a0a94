// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/xde_product_tree.h"

#include <Quantity_ColorRGBA.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelMapHasher.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopLoc_Location.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GraphNode.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace dismantle {

namespace {

constexpr int kDeepestTree = 500;  // nodes from the root to a leaf

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
        tree_(solids, LooseFaces::Together, limit) {}

  Result<CadProductTree> walk() {
    TDF_LabelSequence free;
    shape_tool_->GetFreeShapes(free);
    if (free.Length() != 1) tree_.add_node(root_name_, 0);
    for (int i = 1; i <= free.Length(); ++i) visit(free.Value(i), {}, Path{});
    return tree_.finish();
  }

 private:
  /// `label`: a product; `instance`: the label that places it, null for a free one; `path`: of the instance.
  void visit(const TDF_Label& label, const TDF_Label& instance, Path path) {
    if (path.depth > kDeepestTree) tree_.refuse();
    if (tree_.is_too_large()) return;

    std::string name = name_of_label(label);
    if (name.empty() && !instance.IsNull()) name = name_of_label(instance);
    if (name.empty()) name = root_name_;
    path.parent = tree_.add_node(name, path.parent);

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

  void add_leaf(const TDF_Label& label, const std::string& name, const Path& path) {
    CadOccurrence occurrence;
    occurrence.name = name;
    occurrence.product = product_of(label);
    occurrence.tree_node = path.parent;
    occurrence.placement = path.placement;
    occurrence.instance_color = instance_color(path);
    occurrence.inherited_color = path.inherited_color;
    tree_.add_occurrences(occurrence);
  }

  std::uint32_t product_of(const TDF_Label& label) {
    if (const std::uint32_t* known = products_.Seek(label)) return *known;
    const std::uint32_t product =
        tree_.add_product(XCAFDoc_ShapeTool::GetShape(label), xde_product(color_tool_, label));
    products_.Bind(label, product);
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
  ProductTreeBuilder tree_;
  NCollection_DataMap<TDF_Label, std::uint32_t, TDF_LabelMapHasher> products_;
};

}  // namespace

CadProduct xde_product(const Handle(XCAFDoc_ColorTool) & colors, const TDF_Label& label) {
  CadProduct product;
  product.color = color_of_label(colors, label);
  TDF_LabelSequence subshapes;
  XCAFDoc_ShapeTool::GetSubShapes(label, subshapes);
  for (int i = 1; i <= subshapes.Length(); ++i)
    if (const auto color = color_of_label(colors, subshapes.Value(i)))
      product.subshape_colors.Bind(XCAFDoc_ShapeTool::GetShape(subshapes.Value(i)).Located(TopLoc_Location()), *color);
  return product;
}

Result<CadProductTree> walk_xde_products(const Handle(TDocStd_Document) & document, const std::string& root_name,
                                         Solids solids, std::size_t limit) {
  return Walker(document, root_name, solids, limit).walk();
}

}  // namespace dismantle
