// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/embedded_watch.h"
#include "dismantle/certificates/response/slide_contacts.h"
#include "dismantle/engine/vertex_depth_guard.h"

namespace dismantle {

/// How the set in hand of a CertificateSweeper goes on at contact (docs/design/0006-certificates.md): the loop of one
/// step. Keeps the two rules that triangle pairs' certificates do not: embedded pairs that part, and vertices that get
/// too deep in closed components.
class CertificateResponse {
 public:
  CertificateResponse(CertificateSweeper& sweeper, const Assembly& assembly, const PairStates& pairs);

  /// Another set is in hand now.
  void begin();
  StepResult step(const Pose& target, ResponseKind response);
  void jump(Span<const Pose> poses);
  std::vector<ComponentPair> embedded_pairs() const { return embedded_.pairs(); }

 private:
  /// Whether a motion is made in part where vertices would get too deep further on, or not at all.
  enum class Guarded { Part, Whole };
  CertificateSweep sweep(const Pose& end, double window, Effort effort, StepResult& result);
  /// Goes `part` of the motion to `end`, which the certificates allow, or as far as the other two rules let it.
  /// @return the part made
  double advance(const Pose& end, double part, StepResult& result, Guarded guarded);
  /// How far of a motion that the certificates allow up to `part` the other two rules let through; the watches follow.
  double follow(const Pose& end, double part, Guarded guarded);
  double guarded_part(const Pose& end, double part, Guarded guarded);
  void adopt_parted();
  void report(const CertificateSweep& sweep, StepResult& result) const;

  void go(const Pose& target, bool touch, StepResult& result);
  /// How much of the motion to `end` the certificates allow: up to the first contact less what is kept before it; all
  /// or nothing where not `touch`.
  double free_part(const Pose& end, bool touch, StepResult& result);
  void slide(const Pose& target, StepResult& result);
  /// Whether contacts that let the set hardly move are to be found anew: the first times since it did move, and then
  /// ever more seldom.
  bool look_again();
  /// Goes what cylinders held as one may have kept from it, and tells the contacts.
  void end_slide(const Pose& target, StepResult& result);
  /// Takes up what the guard stopped the last motion for; true where that bounds the twist in a new way.
  bool take_guarded(StepResult& result);
  /// The twist, shortened where contacts bound it and its second-order part would take points too far.
  SlideContacts::Twist bent_little(SlideContacts::Twist twist) const;
  Pose within_arcs(const Pose& target) const;
  Pose twisted(const SlideContacts::Twist& twist) const;
  SlideContacts::Twist twist_to(const Pose& target) const;
  SlideContacts::Twist shortened(SlideContacts::Twist twist, double max_travel) const;
  double travel_of(const SlideContacts::Twist& twist) const;

  CertificateSweeper& sweeper_;
  VertexDepthGuard guard_;
  EmbeddedWatch embedded_;
  std::vector<RigidTransform> from_, to_;                      ///< For the guard.
  std::vector<bool> held_;                                     ///< For the watch.
  std::vector<std::pair<ComponentId, ComponentId>> touching_;  ///< Of the last sweep.
  std::vector<VertexContact> guarded_;                         ///< What the guard found in the last advance.
  SlideContacts contacts_;                                     ///< Of the last step of response Slide.
  std::vector<BlockedPair> stopping_;                          ///< What stopped the last motion of Stop or Touch.
  double reach_;  ///< Slide and Touch try motions of at most this length [mm]: longer ones after they were free.
  unsigned held_times_ = 0;  ///< How often contacts let the set hardly move since it last did.
};

}  // namespace dismantle
