// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/candidate_kernel.h"

namespace dismantle {

/// A station of a screw: the end of one of its pieces.
struct ScrewStation {
  RigidTransform pose;  ///< Of the moving set: world from assembled.
  double reach = 0;     ///< How far a point of the moving set is from where it started, at most [mm].
};

/// The first contacts of many screws from one state, each divided into equal pieces. Item: a candidate.
struct SweepTurning {
  CandidateScene scene;                      ///< The state.
  NearLists lists;                           ///< Of the state.
  Span<const ScrewStation> stations;         ///< Candidate by candidate, the start first.
  Span<const std::uint32_t> stations_begin;  ///< First station of each candidate; one more at the end.
  Span<CandidateContact> found;              ///< Output, one for each candidate.

  /// Candidate i.
  DISMANTLE_HOST_DEVICE void operator()(std::size_t i) const {
    const std::uint32_t begin = stations_begin[i], pieces = stations_begin[i + 1] - begin - 1;
    found[i] = {};
    for (std::uint32_t k = 0; k < pieces; ++k) {
      const CandidateContact contact = first(stations[begin + k], stations[begin + k + 1]);
      if (contact.key == CandidateContact::kFree) continue;
      found[i] = {(k + contact.toi) / pieces, contact.key};
      return;
    }
  }

 private:
  /// The first contact on a piece.
  DISMANTLE_HOST_DEVICE CandidateContact first(const ScrewStation& start, const ScrewStation& end) const {
    const TurningPiece piece(scene, start.pose, end.pose);
    const Reach reach{start.reach, end.reach};
    CandidateContact near;
    if (lists.hold_within(start.reach)) {
      near = CandidateSearch<TurningPiece>(scene, piece).first_of_near(lists, reach);
      if (lists.hold_within(reach.until(near.toi))) return near;
    }
    return CandidateSearch<TurningPiece>(scene, piece, near).first();
  }
};

}  // namespace dismantle
