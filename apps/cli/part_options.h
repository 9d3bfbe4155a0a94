// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"
#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/proposals/find_proposals.h"

#include <nlohmann/json_fwd.hpp>

namespace dismantle::cli {

/// What is known about parts that belong together and parts that give.
struct PartChoices {
  RigidGroups groups{0};               ///< --together, and the proposals if they are accepted.
  std::vector<FlexiblePart> flexible;  ///< --flexible, and the proposals if they are accepted.
  std::vector<Proposal> proposals;     ///< What is proposed besides; nothing with --no-proposals.
  bool accepted = false;               ///< The proposals are in force.
};

/// Declares --together, --accept-proposals and --no-proposals.
void add_together_option(CLI::App& command, CommonOptions& options);
/// Declares --flexible, for commands that move components.
void add_flexible_option(CLI::App& command, CommonOptions& options);

/// Finds what the options name, and the proposals; declares the overlaps of flexible components. Errors: Usage for
/// names that fit nothing.
Result<PartChoices> choose_parts(const Assembly& assembly, PairStates& states, const CommonOptions& options);

/// The parts that belong together or give, and what is proposed, a line each; empty if there is nothing to say.
std::string choices_text(const Assembly& assembly, const PartChoices& choices);

/// The same as members of a report: "together", "flexible" and "proposals".
nlohmann::ordered_json choices_json(const Assembly& assembly, const PartChoices& choices);

}  // namespace dismantle::cli
