// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/cad/sew_faces.h"
#include "dismantle/formats/cad/shape_product_tree.h"
#include "dismantle/formats/cad/stage_progress.h"
#include "dismantle/formats/cad/xde_product_tree.h"

#include <BRepBndLib.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Precision.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDocStd_Document.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Limits of the distance at which edges of neighbouring faces are the same, relative to the diagonal of the faces'
/// box: the resolution that a file states is that of its numbers rather than of its curves.
constexpr double kMinSewingTolerance = 1e-5, kMaxSewingTolerance = 1e-4;

using NameMap = NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher>;

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

/// The names of the entities' shapes; keys without location.
NameMap entity_names(IGESCAFControl_Reader& reader) {
  NameMap names;
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(IGESData_IGESEntity) entity = model->Entity(i);
    const Handle(TCollection_HAsciiString) name = entity->NameValue();
    if (name.IsNull() || name->IsEmpty()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull() || shape.ShapeType() == TopAbs_FACE) continue;
    TCollection_AsciiString trimmed = name->String();
    trimmed.LeftAdjust();
    trimmed.RightAdjust();
    if (!trimmed.IsEmpty()) names.Bind(shape.Located(TopLoc_Location()), trimmed.ToCString());
  }
  return names;
}

/// All free shapes of a document in one compound, and the colours of all.
TopoDS_Shape free_shapes(const Handle(TDocStd_Document) & document, CadProduct& colors) {
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) color_tool = XCAFDoc_DocumentTool::ColorTool(document->Main());
  TDF_LabelSequence free;
  shapes->GetFreeShapes(free);
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (int i = 1; i <= free.Length(); ++i) {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(free.Value(i));
    builder.Add(all, shape);
    const CadProduct own = xde_product(color_tool, free.Value(i));
    if (own.color) colors.subshape_colors.Bind(shape.Located(TopLoc_Location()), *own.color);
    for (decltype(own.subshape_colors)::Iterator color(own.subshape_colors); color.More(); color.Next())
      colors.subshape_colors.Bind(color.Key(), color.Value());
  }
  return free.Length() == 1 ? XCAFDoc_ShapeTool::GetShape(free.Value(1)) : TopoDS_Shape(all);
}

Result<Done> read_document(const CadSource& source, const ProgressCallback& progress, IGESCAFControl_Reader& reader,
                           const Handle(TDocStd_Document) & document) {
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(false);
  reader.SetReadVisible(true);
  if (reader.ReadFile(source.file.c_str()) != IFSelect_RetDone)
    return unreadable("its entities break the grammar of IGES; export it again");
  report_progress(progress, "translating", 0);
  const Handle(StageProgress) indicator = new StageProgress(progress, "translating");
  Handle(TDocStd_Document) target = document;
  if (reader.NbRootsForTransfer() < 1 || !reader.Transfer(target, indicator->Start()))
    return unreadable("it holds no surface and no solid; export the solids with it");
  return Done{};
}

}  // namespace

Result<CadModel> read_iges_model(const CadSource& source, const ImportOptions& options) {
  XCAFDoc_ShapeTool::SetAutoNaming(false);
  IGESCAFControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  const Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  if (const auto read = read_document(source, options.progress, reader, document); !read) return read.error();

  const IGESData_GlobalSection& global = reader.IGESModel()->GlobalSection();
  const LengthUnit unit = length_unit_of(global.UnitValue());
  const double resolution = global.Resolution() * unit.millimetres;
  const NameMap names = entity_names(reader);
  CadProduct colors;
  const TopoDS_Shape whole = free_shapes(document, colors);
  if (whole.IsNull()) return unreadable("it holds no surface and no solid; export the solids with it");

  ShapeNames shape_names;
  shape_names.root = source.name();
  shape_names.name_of = [&](const TopoDS_Shape& shape) {
    const std::string* name = names.Seek(shape);
    return name ? *name : std::string();
  };
  shape_names.product_of = [&](const TopoDS_Shape& shape, CadProduct& product) {
    report_progress(options.progress, "sewing", -1);
    product = colors;
    if (const Color* own = colors.subshape_colors.Seek(shape)) product.color = *own;
    Bnd_Box box;
    BRepBndLib::Add(shape, box, false);
    if (box.IsVoid()) return shape;
    const double diagonal = std::max(std::sqrt(box.SquareExtent()), Precision::Confusion());
    const double tolerance = std::clamp(resolution, kMinSewingTolerance * diagonal, kMaxSewingTolerance * diagonal);
    return sew_loose_faces(shape, tolerance, product);
  };
  Result<CadProductTree> products = walk_shape(whole, shape_names, options);
  if (!products) return products.error();
  return CadModel{std::move(*products), unit, {}};
}

}  // namespace dismantle
