// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/slide_contacts.h"

namespace dismantle {

/// The response of the moving set of a CertificateSweeper to contact (docs/design/0006-certificates.md): the loop of
/// one step.
class CertificateResponse {
 public:
  /// The sweeper must outlive the response.
  explicit CertificateResponse(CertificateSweeper& sweeper);

  /// Forgets the contacts of the last step: another set was grabbed.
  void begin();
  /// As CertificateEngine::step().
  StepResult step(const Pose& target, ResponseKind response);
  /// As CertificateEngine::jump().
  void jump(Span<const Pose> poses);

 private:
  struct SlideState;
  struct SlideTrial;

  CertificateSweep sweep(const ScrewMotion& motion, double window, SweepBudget budget, StepResult& result);
  /// Moves along the motion up to `fraction` of it, which is free, and reports the pose.
  void advance(const ScrewMotion& motion, double fraction, StepResult& result);
  void report(const CertificateSweep& sweep, StepResult& result) const;

  /// Responses Stop and Touch.
  void go(const Pose& target, bool touch, StepResult& result);
  /// The fraction of a motion that the certificates allow: up to the first contact less what is kept before it; all or
  /// nothing if not `touch`.
  double free_fraction(const ScrewMotion& motion, bool touch, StepResult& result);

  ///@{ Response Slide (slide_response.cpp).
  void slide(const Pose& target, StepResult& result);
  /// Chooses the twist to try next from the contacts known.
  SlideTrial choose_trial(SlideState& state);
  /// Makes a motion that was found free. @return false if the step ends
  bool make_free(const SlideTrial& trial, const ScrewMotion& motion, SlideState& state, StepResult& result);
  /// Adds the contacts that block a motion, or makes it up to these. @return false if the step ends
  bool make_blocked(const SlideTrial& trial, const ScrewMotion& motion, const CertificateSweep& found,
                    SlideState& state, StepResult& result);
  /// True if the set gets further on the straight way to its target, before the first contact there, than by a motion
  /// along contacts that makes this share of what is wanted.
  bool is_better_straight(double share, const SlideState& state) const;
  /// Makes that straight part. @return false if nothing of it is made
  bool go_straight(SlideState& state, StepResult& result);
  /// Makes a motion up to a fraction of it, before its first contact, or up to a half or a quarter of that.
  /// @param is_certain that part is known to be free; if not, it is swept before it is made. Parts of rotations never
  /// are: they do not end on the chords that were swept
  /// @return false if nothing of it is made
  bool make_part(const ScrewMotion& motion, double fraction, bool is_certain, StepResult& result);
  /// Time after the first contact in which others are found, as a fraction of the trial's motion.
  double contact_window(const SlideTrial& trial) const;
  /// True if contacts that let the set hardly move are to be found again: the first times since it did move, then ever
  /// more rarely.
  bool search_again();
  /// Makes up for what whole cylinders withheld, and reports the contacts.
  void end_slide(const Pose& target, StepResult& result);
  ///@}

  ///@{ Twists of the moving set about its center.
  SlideContacts::Twist twist_of(const ScrewMotion& motion) const;
  /// The rotation to the target, and the velocity that takes the center there on a straight line.
  SlideContacts::Twist straight_to(const Pose& target) const;
  Pose twisted(const SlideContacts::Twist& twist) const;
  double travel_of(const SlideContacts::Twist& twist) const;
  SlideContacts::Twist shortened(SlideContacts::Twist twist, double max_travel) const;
  /// The twist, shortened if contacts bound it and its second-order part would move points too far.
  SlideContacts::Twist bent_little(SlideContacts::Twist twist) const;
  /// The part of the motion from its start whose arcs are close enough to their chords for one sweep.
  ScrewMotion within_arcs(const ScrewMotion& motion) const;
  ///@}

  CertificateSweeper& sweeper_;
  SlideContacts contacts_;              ///< Of the last step of response Slide.
  std::vector<SweepContact> stopping_;  ///< The pairs that stopped the last motion of Stop or Touch.
  double reach_;               ///< Slide and Touch try motions of at most this length [mm]; it grows after free ones.
  unsigned hardly_moved_ = 0;  ///< Times that contacts let the set hardly move since it last did.
  bool unfinished_ = false;    ///< The last step ended at the limit of tests.
  bool undecided_ = false;     ///< It did not bound a depth within its limit, and is to end.
  Pose resting_;               ///< The pose since which such steps, and unfinished ones, are counted.
  int undecided_steps_ = 0;    ///< Steps that ended so since the set last moved by more than a tolerance.
  int unfinished_steps_ = 0;   ///< Unfinished steps in turn since then.
  bool keeps_axes_ = false;    ///< It found contacts that were not used: the next step takes their axes as they are.
};

/// A pair of triangles of a moving and a fixed component as StepResult reports it.
/// @tparam Pair has moving, fixed, face_moving and face_fixed
template <class Pair>
BlockingPair blocking_pair_of(const Pair& pair, double toi) {
  if (pair.moving < pair.fixed) return {pair.moving, pair.fixed, pair.face_moving, pair.face_fixed, toi};
  return {pair.fixed, pair.moving, pair.face_fixed, pair.face_moving, toi};
}

}  // namespace dismantle
