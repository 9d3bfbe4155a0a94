// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <filesystem>
#include <gp_Ax1.hxx>
#include <gp_Trsf.hxx>

namespace dismantle {

/// Builds a product tree and writes it as STEP or IGES, for tests that read files of known content.
class CadWriter {
 public:
  CadWriter() : document_(new TDocStd_Document("BinXCAF")) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    XCAFDoc_ShapeTool::SetAutoNaming(false);
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    colors_ = XCAFDoc_DocumentTool::ColorTool(document_->Main());
  }

  TDF_Label part(const char* name, const TopoDS_Shape& shape) {
    const TDF_Label label = shapes_->AddShape(shape, false);
    TDataStd_Name::Set(label, TCollection_ExtendedString(name, true));
    return label;
  }
  TDF_Label assembly(const char* name) {
    const TDF_Label label = shapes_->NewShape();
    TDataStd_Name::Set(label, TCollection_ExtendedString(name, true));
    return label;
  }
  TDF_Label instance(const TDF_Label& assembly, const TDF_Label& product, const gp_Trsf& placement,
                     const char* name = "an instance") {
    const TDF_Label label = shapes_->AddComponent(assembly, product, TopLoc_Location(placement));
    TDataStd_Name::Set(label, TCollection_ExtendedString(name, true));
    return label;
  }
  /// Colours a product or an instance; sRGB.
  void color(const TDF_Label& label, double r, double g, double b) {
    colors_->SetColor(label, Quantity_Color(r, g, b, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  }
  /// Colours a face or solid of a product.
  void color(const TDF_Label& product, const TopoDS_Shape& subshape, double r, double g, double b) {
    color(shapes_->AddSubShape(product, subshape), r, g, b);
  }

  /// Writes STEP. `unit`: "MM", "M", "INCH", ... @return false if it cannot be written
  bool write(const std::filesystem::path& file, const char* unit = "MM") {
    shapes_->UpdateAssemblies();
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPCAFControl_Writer writer;
    return writer.Transfer(document_) && writer.Write(file.c_str()) == IFSelect_RetDone;
  }

  /// The ways in which IGES has solids.
  enum class IgesSolids { TrimmedSurfaces, Brep };
  /// Writes IGES. @return false if it cannot be written
  bool write_iges(const std::filesystem::path& file, IgesSolids solids, const char* unit = "MM") {
    shapes_->UpdateAssemblies();
    IGESControl_Controller::Init();
    Interface_Static::SetIVal("write.iges.brep.mode", solids == IgesSolids::Brep ? 1 : 0);
    Interface_Static::SetCVal("write.iges.unit", unit);
    IGESCAFControl_Writer writer;
    return writer.Transfer(document_) && writer.Write(file.c_str());
  }

 private:
  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
};

inline gp_Trsf translation(double x, double y, double z) {
  gp_Trsf t;
  t.SetTranslation(gp_Vec(x, y, z));
  return t;
}

inline gp_Trsf rotation_about_z(double angle) {
  gp_Trsf t;
  t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), angle);
  return t;
}

}  // namespace dismantle
