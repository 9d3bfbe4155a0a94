// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/sample_model.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <stdexcept>

namespace dismantle::samples {
namespace {

void set_name(const TDF_Label& label, const std::string& name) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str(), true));
}

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  return document;
}

/// A file is a value: no clock and no user name in it.
void set_header(STEPCAFControl_Writer& writer, const std::string& name) {
  APIHeaderSection_MakeHeader header(Handle(StepData_StepModel)::DownCast(writer.ChangeWriter().WS()->Model()));
  header.SetName(new TCollection_HAsciiString((name + ".step").c_str()));
  header.SetTimeStamp(new TCollection_HAsciiString("2000-01-01T00:00:00"));
  header.SetAuthorValue(1, new TCollection_HAsciiString("dismantle"));
  header.SetOrganizationValue(1, new TCollection_HAsciiString("dismantle samples, Apache-2.0"));
}

}  // namespace

SampleModel::SampleModel(std::string name) : name_(std::move(name)) {}

ProductId SampleModel::product(const std::string& name, const Solid& solid, const Paint& paint) {
  products_.push_back({name, solid, paint});
  return {static_cast<int>(products_.size()) - 1};
}

GroupId SampleModel::group(const std::string& name) {
  groups_.push_back({name, {}});
  return {static_cast<int>(groups_.size()) - 1};
}

void SampleModel::place(GroupId group, ProductId product, const Placement& placement) {
  groups_[static_cast<std::size_t>(group.index)].instances.push_back({product.index, placement});
}

void SampleModel::place_all(GroupId group, ProductId product, const std::vector<Placement>& placements) {
  for (const Placement& placement : placements) place(group, product, placement);
}

void SampleModel::add(GroupId group, const std::string& name, const Solid& solid, const Paint& paint,
                      const Placement& placement) {
  place(group, product(name, solid, paint), placement);
}

std::vector<Occurrence> SampleModel::occurrences() const {
  std::vector<Occurrence> all;
  std::map<std::string, int> uses;
  for (const Group& group : groups_)
    for (const Instance& instance : group.instances) {
      std::string name = products_[static_cast<std::size_t>(instance.product)].name;
      const int use = ++uses[name];
      if (use > 1) name += "#" + std::to_string(use);
      all.push_back({name, instance.product, instance.placement});
    }
  return all;
}

void SampleModel::write_step(const std::filesystem::path& file) const {
  const Handle(TDocStd_Document) document = new_document();
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  std::vector<TDF_Label> labels;
  for (const Product& product : products_) {
    const TDF_Label label = shapes->AddShape(product.solid.shape(), false);
    set_name(label, product.name);
    colors->SetColor(label, Quantity_Color(product.paint.r, product.paint.g, product.paint.b, Quantity_TOC_sRGB),
                     XCAFDoc_ColorSurf);
    labels.push_back(label);
  }
  const TDF_Label root = shapes->NewShape();
  set_name(root, name_);
  for (const Group& group : groups_) {
    const TDF_Label node = shapes->NewShape();
    set_name(node, group.name);
    for (const Instance& instance : group.instances) {
      const auto index = static_cast<std::size_t>(instance.product);
      set_name(shapes->AddComponent(node, labels[index], TopLoc_Location(instance.placement)), products_[index].name);
    }
    set_name(shapes->AddComponent(root, node, TopLoc_Location()), group.name);
  }
  shapes->UpdateAssemblies();

  STEPCAFControl_Writer writer;
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);  // curves in space only: half the size
  writer.SetNameMode(true);
  writer.SetColorMode(true);
  if (!writer.Transfer(document, STEPControl_AsIs)) throw std::runtime_error("cannot turn " + name_ + " into STEP");
  set_header(writer, name_);
  if (writer.Write(file.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace dismantle::samples
