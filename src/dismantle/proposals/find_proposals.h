// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/flexible_part.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/result.h"

#include <string>
#include <vector>

namespace dismantle {

/// What a person would probably say about some components before they are taken apart, and why.
struct Proposal {
  /// What a proposal is about.
  enum class Kind : std::uint8_t {
    Together,  ///< They are one purchased part, which is not taken apart.
    Flexible,  ///< The component gives.
  };
  Kind kind = Kind::Together;           ///< What is proposed.
  std::vector<ComponentId> components;  ///< Ascending; one for Flexible.
  FlexiblePart flexible;                ///< For Flexible.
  std::string name;                     ///< Of the sub-assembly, or of a component.
  std::string reason;                   ///< "its name says 'bearing'", "12 balls in a ring".
};

/// Proposes what belongs together, then what gives, each in the order of their first components:
/// - sub-assemblies of the product tree whose names say that they are purchased: bearings, motors, boards, connectors;
/// - products of several solids that are placed more than once: lock nuts with their inserts;
/// - rings of at least five equal balls, with the components around their common axis that are no further than the
/// races;
/// - boards: plates with at least ten components on or in them that touch nothing else;
/// - components that touch others and are O-rings (a torus) or circlips (an open ring) by their shape, or give by their
///   names.
/// Nothing is proposed that would make one part of everything.
std::vector<Proposal> find_proposals(const Assembly& assembly, const PairStates& states);

/// The flexible components that a user names, as NAME or NAME=MM; a NAME may be a pattern with * and ?. Without a
/// number, the depth is the thickness of the component (section_of). Errors: Usage where a name fits nothing, or the
/// number is none above 0.
Result<std::vector<FlexiblePart>> named_flexible(const Assembly& assembly, Span<const std::string> texts);

}  // namespace dismantle
