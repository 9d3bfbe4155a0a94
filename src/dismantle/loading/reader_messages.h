// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/byte_stream.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// What load_assembly() asks a reader program for.
struct ReaderRequest {
  std::string version;         ///< Of dismantle: a reader of another one refuses.
  std::filesystem::path file;  ///< To be read.
  ImportOptions options;       ///< Without cache_folder, progress and what is done after reading.
};

/// The bytes of a request, and back; none if they are malformed.
std::string bytes_of(const ReaderRequest& request);
/// See bytes_of().
std::optional<ReaderRequest> reader_request_from(std::string_view bytes);

/// Writes a reader's answer: the linked files, then the assembly.
void write_answer(const ImportedAssembly& imported, const ByteSink& sink);
/// The linked files of an answer; none if it is malformed.
std::optional<std::vector<LinkedFile>> linked_files_in(std::string_view answer);
/// The assembly of an answer; none if it is malformed.
std::optional<Assembly> assembly_in(std::string_view answer);

}  // namespace dismantle
