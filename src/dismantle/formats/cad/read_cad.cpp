// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/read_cad.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/cad/cad_assembly.h"
#include "dismantle/formats/cad/cad_frame.h"
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/units.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <OSD_Parallel.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <algorithm>
#include <new>
#include <string>

namespace dismantle {

namespace {

using ModelReader = Result<CadModel> (*)(const CadSource&, const ImportOptions&);

ModelReader model_reader(FileFormat format) {
  switch (format) {
    case FileFormat::Step:
      return read_step_model;
    case FileFormat::Iges:
      return read_iges_model;
    case FileFormat::Brep:
      return read_brep_model;
    case FileFormat::FreeCad:
      return read_freecad_model;
    default:
      return nullptr;
  }
}

/// The hash of a file and of those that it links to.
std::string hash_with(const std::string& content, const std::vector<LinkedFile>& linked_files) {
  if (linked_files.empty()) return content;
  std::string all = content;
  for (const LinkedFile& linked : linked_files) all += linked.sha256;
  return sha256(all);
}

/// Errors: "<why>; <what to do>".
Result<ImportedAssembly> import_cad(ModelReader read, const CadSource& source, const ImportOptions& options) {
  try {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    OSD_Parallel::SetUseOcctThreads(true);  // TBB's threads may have been the parent's, and are not here
    Result<CadModel> model = read(source, options);
    if (!model) return model.error();
    std::vector<LinkedFile> linked_files = std::move(model->linked_files);
    Result<Assembly> assembly = assembly_from_cad(std::move(*model), options);
    if (!assembly) return assembly.error();
    return ImportedAssembly{std::move(*assembly), std::move(linked_files)};
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    std::string text = failure.GetMessageString() == nullptr ? "" : failure.GetMessageString();
    text.resize(std::min(text.find_first_of("\r\n"), text.size()));  // what caused what follows, with addresses
    return Error{ErrorKind::Unreadable, "the CAD kernel gave up on it: " + std::string(failure.DynamicType()->Name()) +
                                            " " + text + "; check it in the program that wrote it"};
  }
}

}  // namespace

bool is_cad_file(const std::filesystem::path& file) {
  const FormatEntry* entry = format_of(file);
  return entry != nullptr && model_reader(entry->format) != nullptr;
}

Result<ImportedAssembly> read_cad(const std::filesystem::path& file, const ImportOptions& options) {
  DISMANTLE_EXPECT(is_cad_file(file));
  if (!options.units.empty())
    if (const Result<double> known = millimetres_per_unit(options.units); !known) return known.error();
  const FormatEntry& entry = *format_of(file);
  const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  if (const Result<Done> frame = check_cad_frame(entry.format, *bytes); !frame)
    return unreadable_as(file, entry.name, frame.error());
  Result<ImportedAssembly> imported = import_cad(model_reader(entry.format), {*bytes, file}, options);
  if (!imported) return unreadable_as(file, entry.name, imported.error());
  imported->assembly.source_file = file.filename().string();
  imported->assembly.source_sha256 = hash_with(sha256(*bytes), imported->linked_files);
  return imported;
}

}  // namespace dismantle
