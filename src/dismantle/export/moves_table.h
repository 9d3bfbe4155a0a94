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

/// How near a move comes to what does not move.
struct MoveClearance {
  double distance = 0;    ///< The least at any frame [mm]; 0 where surfaces meet, infinite where there is nothing else.
  double time = 0;        ///< Of the first such frame, in the move [s].
  ComponentId neighbour;  ///< What is so near; invalid where there is nothing else.
};

/// The least clearance of each move at its frames, exact there. Nothing is told between frames. Embedded pairs do not
/// count. @return nothing where it was cancelled
std::optional<std::vector<MoveClearance>> move_clearances(const Assembly& assembly, const PairStates& pairs,
                                                          const Timeline& timeline,
                                                          const CertificateOptions& options = {},
                                                          const ProgressCallback& progress = {});

struct MovesTableOptions {
  PathDirection direction = PathDirection::Forward;
  std::vector<MoveClearance> clearances;  ///< Of each move of the timeline, or empty: not known.
};

/// The moves as CSV (RFC 4180), a row each with a header, in the order in which they are gone; the columns are in
/// docs/formats.md.
std::string moves_csv(const Assembly& assembly, const Timeline& timeline, const MovesTableOptions& options = {});

}  // namespace dismantle
