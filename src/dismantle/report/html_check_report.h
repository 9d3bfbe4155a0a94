// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

#include <cstddef>
#include <string>

namespace dismantle {

/// Options of html_check_report.
struct HtmlCheckOptions {
  std::size_t pictures = 24;  ///< Close-ups of embedded and fit pairs, worst first, at most.
  int picture_width = 640;    ///< [pixels]
  int picture_height = 480;   ///< [pixels]
  Executor executor;
  ProgressCallback progress;
};

/// The clash report as one HTML page (well-formed XML, too) that needs nothing else: a table of the pairs that can be
/// sorted and searched, pictures of the assembly and, from near, of the overlaps. It loads nothing from anywhere, and
/// its own policy forbids it to. Same input, same bytes. Errors: Failed where `progress` cancelled.
Result<std::string> html_check_report(const Assembly& assembly, const PairStates& states,
                                      const HtmlCheckOptions& options = {});

}  // namespace dismantle
