// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"
#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/planner/plan.h"
#include "dismantle/proposals/find_proposals.h"

#include <nlohmann/json_fwd.hpp>

namespace dismantle::cli {

/// What is known about parts that belong together and parts that give.
struct PartChoices {
  RigidGroups named{0};                ///< --together.
  RigidGroups groups{0};               ///< The same, and what is accepted.
  std::vector<FlexiblePart> flexible;  ///< --flexible, and what is accepted.
  std::vector<Proposal> accepted;      ///< Proposals in force, with --accept-proposals.
  std::vector<Proposal> open;          ///< Others; nothing with --no-proposals.
  std::vector<Proposal> taken_back;    ///< Accepted first, and not in force, as something would stay (take_back()).
};

/// Declares --together, --accept-proposals and --no-proposals.
void add_together_option(CLI::App& command, CommonOptions& options);
/// Declares --flexible, for commands that move components.
void add_flexible_option(CLI::App& command, CommonOptions& options);

/// Finds what the options name, and the proposals; declares the overlaps of flexible components. Errors: Usage for
/// names that fit nothing.
Result<PartChoices> choose_parts(const Assembly& assembly, PairStates& states, const CommonOptions& options);

/// Leaves out of accepted proposals of one part the components that block others that stay in a plan, or else those
/// that touch such others, with the fasteners that hold them: a rod that is hooked into the arm of a servo stays as
/// long as the arm stays on the servo, which without its arm still is one part. @param states of the plan @return false
/// if there are none
bool take_back_some(PartChoices& choices, const PairStates& states, const Plan& plan);
/// Takes back whole accepted proposals of one part with components that stay in a plan or block one that does.
/// @return false if there are none
bool take_back(PartChoices& choices, const Plan& plan);

/// The parts that belong together or give, and what is proposed, a line each; empty if there is nothing to say.
std::string choices_text(const Assembly& assembly, const PartChoices& choices);

/// The same as members of a report: "together", "flexible" and "proposals".
nlohmann::ordered_json choices_json(const Assembly& assembly, const PartChoices& choices);

}  // namespace dismantle::cli
