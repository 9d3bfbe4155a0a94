// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/certificate_response.h"

#include <optional>

/// Declarations that the sources of CertificateResponse share.
namespace dismantle {

/// Motions shorter than this share of the tolerance are not made: a resting set keeps its pose bit for bit.
inline constexpr double kRestShare = 2e-3;
/// After a motion that was stopped the next trial is at most this many tolerances long, or twice what was made.
inline constexpr double kMinTry = 4;
/// After a motion that was free the next trial may be longer by this factor.
inline constexpr double kTryGrowth = 4;

/// The state of one step of response Slide.
struct CertificateResponse::SlideState {
  /// The part before its first contact of a motion to the target.
  struct Straight {
    ScrewMotion motion;       ///< That was tried.
    double fraction = 0;      ///< Of the motion, up to the first contact found.
    double share = 0;         ///< Of what is wanted.
    bool is_certain = false;  ///< It is free: the sweep found all contacts, and the motion is linear.
  };

  Pose target;                 ///< Of the step.
  int tries = 0;               ///< Sweeps so far, apart from free ones of an unbounded motion.
  bool axes_chosen = false;    ///< The contacts' axes are those of the motion that is wanted from the present pose.
  bool contacts_here = false;  ///< All contacts were found at the present pose.
  bool on_course = false;      ///< The last motion was on the screw to the target.
  /// From the present pose; none where the motion to the target was not tried there, or was free.
  std::optional<Straight> straight;
  SweepBudget budget = SweepBudget::WholeCylinders;  ///< Of the next sweep.
};

/// A motion that a step of response Slide tries.
struct CertificateResponse::SlideTrial {
  SlideContacts::Twist twist;  ///< That the contacts allow.
  double travel = 0;           ///< Path length of the twist [mm].
  double share = 0;            ///< By how much it brings the set to the target, as a share of what is wanted.
  bool creeping = false;       ///< The contacts let the set hardly move.
  ScrewMotion motion;          ///< To be tried.
};

}  // namespace dismantle
