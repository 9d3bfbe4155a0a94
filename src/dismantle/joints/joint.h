// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/math/vec3.h"

#include <string>
#include <vector>

namespace dismantle {

/// How far a threaded fastener is turned until its thread ends.
struct Unscrewing {
  double turns = 0;          ///< Number of turns; 0 where the pitch is unknown.
  double travel = 0;         ///< Along the axis meanwhile [mm].
  double pitch = 0;          ///< Of the thread [mm]; 0 where it is unknown.
  bool left_handed = false;  ///< A left-hand thread: it comes out clockwise.
  bool nominal = true;       ///< The pitch is that of the standard, coarse: the thread is not modelled.

  friend bool operator==(const Unscrewing&, const Unscrewing&) = default;
};

/// "unscrew 12 turns anticlockwise, 9.6 mm (nominal pitch 0.8 mm)", seen from where it comes out; "unscrew, 9.6 mm"
/// where the pitch is unknown.
std::string unscrewing_text(const Unscrewing& unscrewing);
/// The same for the way back: "screw in 12 turns clockwise, 9.6 mm (nominal pitch 0.8 mm)".
std::string screwing_in_text(const Unscrewing& unscrewing);

/// The ring inside a lock nut, which comes off with the nut.
struct NutInsert {
  ComponentId insert;  ///< The ring.
  ComponentId nut;     ///< The nut that it is in.
  /// By `insert`, then by `nut`.
  friend auto operator<=>(const NutInsert&, const NutInsert&) = default;
};

/// A threaded fastener, what comes off with it, and what it holds, in the assembled state.
struct Joint {
  /// The screw, bolt, or standoff with a stud; invalid for a nut on a stud that is part of `thread_in`.
  ComponentId screw;
  std::vector<ComponentId> nuts;          ///< Nuts on it, from the tip to the head.
  std::vector<ComponentId> head_washers;  ///< Washers between its head and what it holds, ascending.
  std::vector<ComponentId> nut_washers;   ///< Washers between its nuts and what it holds, ascending.
  std::vector<NutInsert> nut_inserts;     ///< Of its nuts that are lock nuts, ascending.
  /// All other components that the shank passes through, or that the head, the nut, or the tip of a set screw presses
  /// on; ascending. With the component in which the thread ends, if that is not a nut.
  std::vector<ComponentId> held;
  ComponentId thread_in;    ///< The component with the inner thread: of `nuts` or of `held`.
  bool has_head = true;     ///< False for set screws and threaded rods, which may leave either way.
  Vec3 axis;                ///< Unit; from the tip to the head [assembly frame]. Of nuts on a stud: of either sign.
  Unscrewing screw_leaves;  ///< Unscrewing of `screw` out of `thread_in`.
  Unscrewing nut_leaves;    ///< Unscrewing of the nut nearest to the tip.

  /// The fasteners and washers in the order in which they come off: nuts, their inserts and washers, the screw, its
  /// washers.
  std::vector<ComponentId> stack() const;

  friend bool operator==(const Joint&, const Joint&) = default;
};

}  // namespace dismantle
