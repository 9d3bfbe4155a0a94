// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// A pose at a time of a move. Between two frames the moving set follows the screw motion between them (math/screw.h).
struct Frame {
  double time = 0;  ///< Time of the move [s].
  Pose pose;        ///< Of the moving set, relative to the assembled state.
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// One move of a path: the moving set goes rigidly through the frames; all other components stand still.
struct Move {
  std::string label;                    ///< A name for people.
  std::vector<std::string> components;  ///< Names of the moving set.
  std::vector<Frame> frames;            ///< In the order of time.
  friend bool operator==(const Move&, const Move&) = default;
};

/// Why a pair of a path may be deeper than the tolerance.
enum class PathPairState {
  Overlapping,  ///< The components overlap in the assembled state.
  Declared,     ///< The user allowed it: a flexible part.
  Free,         ///< Not checked until the components have been apart (ClassifyRule::Paper, method `streams`).
};

/// The name of a state in path files: "overlapping", "declared" or "free".
std::string_view name_of(PathPairState state);

/// A pair that may be deeper in each other than the tolerance until it has been apart.
struct PathPair {
  ///@{ Names of the components.
  std::string a, b;
  ///@}
  PathPairState state = PathPairState::Overlapping;  ///< Why it may be.
  double initial_depth = 0;  ///< Depth of the solids in the assembled state, an upper bound [mm].
  double allowed_depth = 0;  ///< Depth allowed until the two have been apart [mm]; infinite for Free.
  friend bool operator==(const PathPair&, const PathPair&) = default;
};

/// The version of the path files that are written.
inline constexpr int kPathVersion = 2;

/// The moves that a session recorded or a planner found: docs/formats.md, `*.path.json`.
struct Path {
  /// Version of the file. In version 1, which measured depth between triangles, `pairs` is empty: it does not tell
  /// which components overlap.
  int version = kPathVersion;
  std::string assembly_file;            ///< Assembly::source_file.
  std::string assembly_sha256;          ///< Assembly::source_sha256.
  std::vector<std::string> components;  ///< Names of all components of the assembly.
  double tolerance = 0;                 ///< Depth allowed for all pairs that are not listed [mm].
  std::vector<PathPair> pairs;          ///< Pairs that may be deeper than that.
  std::vector<Move> moves;              ///< In order.
  std::vector<std::string> removed;     ///< Names of the components that are removed in the end.
  friend bool operator==(const Path&, const Path&) = default;
};

/// The frames of a move in reverse, from its last one at time 0 to its first.
std::vector<Frame> reversed(std::vector<Frame> frames);

/// A path followed by its reverse, move by move from the last, so that every component ends where it began: the
/// disassembly and the assembly. Labels of reversed moves end in ", reversed"; no component is removed in the end.
Path there_and_back(Path path);

/// The response of a motion to contact.
enum class ResponseKind {
  Stop,   ///< Returns to the last collision-free pose (Du et al. 2015).
  Touch,  ///< Ends at the first contact.
  Slide,  ///< Continues along the contact.
};

/// The name of a response in files and on the command line: "stop", "touch" or "slide".
std::string_view name_of(ResponseKind response);

/// The target poses of a moving set over time, one simulation step for each.
struct MotionMove {
  std::vector<std::string> components;  ///< Names of the moving set.
  std::vector<Frame> targets;           ///< In the order of time.
  friend bool operator==(const MotionMove&, const MotionMove&) = default;
};

/// Targets of one moving set after another: docs/formats.md, `*.motion.json`.
struct Motion {
  ResponseKind response = ResponseKind::Slide;  ///< At contact.
  std::vector<MotionMove> moves;                ///< In order.
  friend bool operator==(const Motion&, const Motion&) = default;
};

}  // namespace dismantle
