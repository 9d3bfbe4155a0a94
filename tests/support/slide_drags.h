// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/session/play_motion.h"
#include "tests/support/slide_motions.h"

/// Drags of a component by a simulated hand, with an audit of the path.
namespace dismantle::scenes {

/// A drag, and the audit of its path.
struct Drag {
  PlayedMotion played;
  AuditReport audit;
};

/// Plays the targets with method `certificates` from the assembled state, and audits the path.
inline Drag drag(const SlideScene& scene, double tolerance, const std::vector<Pose>& targets) {
  const PairStates states = states_of(scene.assembly, tolerance);
  CertificateEngine engine(scene.assembly, states);
  Drag made;
  made.played = play_motion(scene.assembly, states, motion_of(scene, targets), engine).value();
  made.audit = audit_path(scene.assembly, made.played.path);
  return made;
}

/// The number of steps after which the component is out; 0 if it never is.
inline int steps_until_out(const SlideScene& scene, const Drag& made) {
  for (std::size_t k = 0; k < made.played.steps.size(); ++k)
    if (distance_moved(scene, made.played.steps[k].result.pose) >= scene.exit_distance) return static_cast<int>(k) + 1;
  return 0;
}

/// The number of steps in which the component must be out: those of a straight pull of `step` mm, and a fifth more.
inline int steps_allowed(const SlideScene& scene, double step) {
  return static_cast<int>(1.2 * std::ceil(scene.exit_distance / step));
}

/// The violations that an audit found, for a message.
inline std::string violations_of(const AuditReport& report) {
  std::string text = std::to_string(report.violations.size()) + " violations";
  for (std::size_t k = 0; k < report.violations.size() && k < 3; ++k) text += "; " + report.violations[k].message;
  return text;
}

}  // namespace dismantle::scenes
