// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/cad/stage_progress.h"
#include "dismantle/formats/cad/text_buffer.h"
#include "dismantle/formats/cad/xde_product_tree.h"

#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <istream>

namespace dismantle {

namespace {

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

/// The units that a STEP entity assigns to a representation; null if it is not such an entity.
Handle(StepRepr_GlobalUnitAssignedContext) assigned_units(const Handle(Standard_Transient) & entity) {
  using WithUncertainty = StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx;
  using WithoutUncertainty = StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext;
  if (const auto* context = dynamic_cast<const WithUncertainty*>(entity.get()))
    return context->GlobalUnitAssignedContext();
  if (const auto* context = dynamic_cast<const WithoutUncertainty*>(entity.get()))
    return context->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
}

/// The first length unit of a representation in the file; mm if there is none.
LengthUnit length_unit(const Interface_InterfaceModel& model) {
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepRepr_GlobalUnitAssignedContext) units = assigned_units(model.Value(i));
    if (units.IsNull()) continue;
    STEPConstruct_UnitContext context;
    if (context.ComputeFactors(units) != 0 || !context.LengthDone()) continue;
    if (context.LengthFactor() > 0) return length_unit_of(context.LengthFactor());
  }
  return {};
}

Result<Done> read_document(const CadSource& source, const ProgressCallback& progress, STEPCAFControl_Reader& reader,
                           const Handle(TDocStd_Document) & document) {
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(false);
  reader.SetPropsMode(false);
  reader.SetSHUOMode(true);
  TextBuffer buffer(source.bytes, progress);
  std::istream stream(&buffer);
  if (reader.ChangeReader().ReadStream(source.name().c_str(), stream) != IFSelect_RetDone)
    return unreadable("its entities break the grammar of STEP; export it again");
  report_progress(progress, "translating", 0);
  const Handle(StageProgress) indicator = new StageProgress(progress, "translating");
  Handle(TDocStd_Document) target = document;
  if (reader.NbRootsForTransfer() < 1 || !reader.Transfer(target, indicator->Start()))
    return unreadable("it holds no product with a shape; export the solids with it");
  return Done{};
}

}  // namespace

Result<CadModel> read_step_model(const CadSource& source, const ImportOptions& options) {
  XCAFDoc_ShapeTool::SetAutoNaming(false);
  STEPCAFControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  const Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  if (const auto read = read_document(source, options.progress, reader, document); !read) return read.error();
  Result<CadProductTree> products =
      walk_xde_products(document, source.name(), options.solids, options.limits.components);
  if (!products) return products.error();
  return CadModel{std::move(*products), length_unit(*reader.Reader().Model()), {}};
}

}  // namespace dismantle
