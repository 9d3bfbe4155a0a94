// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/export/path_animations.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// Minimum clearance between the moving set and the stationary components during a move.
struct MoveClearance {
  double distance = 0;    ///< Minimum over the frames [mm]; 0 at contact, infinite without other components.
  double time = 0;        ///< Time of the first frame with that distance, from the start of the move [s].
  ComponentId neighbour;  ///< The nearest component in that frame; invalid without other components.
};

/// The minimum clearance of each move of a timeline. Exact at frames; not evaluated between them. Embedded pairs are
/// ignored. @return nothing if cancelled
std::optional<std::vector<MoveClearance>> move_clearances(const Assembly& assembly, const PairStates& pairs,
                                                          const Timeline& timeline,
                                                          const CertificateOptions& options = {},
                                                          const ProgressCallback& progress = {});

/// Options of moves_csv().
struct MovesTableOptions {
  PathDirection direction = PathDirection::Forward;  ///< Order of the moves.
  std::vector<MoveClearance> clearances;             ///< One per move of the timeline, or empty if unknown.
};

/// The moves as CSV (RFC 4180): a header, and one row per move in the order of the direction. Columns: docs/formats.md.
std::string moves_csv(const Assembly& assembly, const Timeline& timeline, const MovesTableOptions& options = {});

}  // namespace dismantle
