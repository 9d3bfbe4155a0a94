// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "apps/server/session_json.h"
#include "dismantle/instructions/instructions_file.h"

#include <memory>
#include <string>

namespace dismantle::server {

/// Work instructions to make: a copy of the session's data, so that they can be made on any thread.
struct InstructionsRequest {
  std::shared_ptr<const Assembly> assembly;  ///< The open assembly.
  PairStates pairs;                          ///< Of the assembly.
  Path path;                                 ///< Has at least one move.
  InstructionsFileOptions options;           ///< As given by the command.
};

/// Work instructions that were made.
struct MadeInstructions {
  ExportFormat format = ExportFormat::InstructionsHtml;  ///< As requested.
  std::shared_ptr<const std::string> bytes;              ///< The file.
  std::vector<std::string> notes;                        ///< See InstructionsFile.
};

/// The request of the command `instructions` of docs/wire.md. Call on the engine loop's thread. Errors: Usage if a
/// member is wrong or there is no path; Unreadable as of parse_path.
Result<InstructionsRequest> instructions_request(const Json& command, const Model& model);

/// Makes the file. May take minutes. For any thread. Errors: of instructions_file(); Unreadable if the path does not
/// fit the assembly; Failed if `progress` cancels.
Result<MadeInstructions> make_instructions(const InstructionsRequest& request, const ProgressCallback& progress);

}  // namespace dismantle::server
