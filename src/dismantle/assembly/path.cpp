// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/path.h"

#include <algorithm>

namespace dismantle {

std::string_view name_of(PathPairState state) {
  switch (state) {
    case PathPairState::Overlapping:
      return "overlapping";
    case PathPairState::Declared:
      return "declared";
    case PathPairState::Free:
      return "free";
  }
  return "";
}

std::vector<Frame> reversed(std::vector<Frame> frames) {
  std::reverse(frames.begin(), frames.end());
  const double duration = frames.empty() ? 0 : frames.front().time;
  for (Frame& frame : frames) frame.time = duration - frame.time;
  return frames;
}

Path there_and_back(Path path) {
  path.moves.reserve(2 * path.moves.size());
  for (std::size_t i = path.moves.size(); i-- > 0;) {
    const Move& move = path.moves[i];
    path.moves.push_back({move.label + ", reversed", move.components, reversed(move.frames)});
  }
  path.removed.clear();
  return path;
}

std::string_view name_of(ResponseKind response) {
  switch (response) {
    case ResponseKind::Stop:
      return "stop";
    case ResponseKind::Touch:
      return "touch";
    case ResponseKind::Slide:
      return "slide";
  }
  return "";
}

}  // namespace dismantle
