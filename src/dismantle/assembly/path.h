// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/math/rigid_transform.h"

#include <string>
#include <vector>

namespace dismantle {

/// A pose at a time [s] of a move. Between two frames the set follows the one screw motion (math/screw.h).
struct Frame {
  double time = 0;
  Pose pose;
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// One move of a path: the named components go rigidly together through the frames; everything else stands still.
struct Move {
  std::string label;
  std::vector<std::string> components;
  std::vector<Frame> frames;
  friend bool operator==(const Move&, const Move&) = default;
};

/// A pair that is allowed more penetration than the tolerance. For Embedded the allowance is infinite until they part.
struct PathPair {
  std::string a, b;
  PairState state = PairState::Fit;  ///< Fit or Embedded.
  double allowed_penetration = 0;    ///< [mm]
  friend bool operator==(const PathPair&, const PathPair&) = default;
};

/// What a session records and a planner returns: docs/formats.md, `*.path.json`.
struct Path {
  std::string assembly_file;
  std::string assembly_sha256;
  std::vector<std::string> components;
  double tolerance = 0;  ///< [mm]
  std::vector<PathPair> pairs;
  std::vector<Move> moves;
  std::vector<std::string> removed;
  friend bool operator==(const Path&, const Path&) = default;
};

/// The frames of a move the other way, from its last one at time 0 to its first.
std::vector<Frame> reversed(std::vector<Frame> frames);

/// A path and then its way back, move by move from the last, so that every component ends where it began: how an
/// assembly that a path takes apart is put together again. The labels of the way back end in ", reversed"; nothing is
/// removed in the end.
Path there_and_back(Path path);

/// How a motion goes on at contact.
enum class ResponseKind {
  Stop,   ///< Back to the last collision-free pose (Du et al. 2015).
  Touch,  ///< Up to the first contact.
  Slide,  ///< On along the contact.
};

/// "stop", "touch", "slide": as files and the command line have it.
std::string_view name_of(ResponseKind response);

/// Where the hand wants the components to be at each time; one simulation step a target. docs/formats.md,
/// `*.motion.json`.
struct MotionMove {
  std::vector<std::string> components;
  std::vector<Frame> targets;
  friend bool operator==(const MotionMove&, const MotionMove&) = default;
};

struct Motion {
  ResponseKind response = ResponseKind::Slide;
  std::vector<MotionMove> moves;
  friend bool operator==(const Motion&, const Motion&) = default;
};

}  // namespace dismantle
