// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

#include <cstddef>
#include <string>

namespace dismantle {

/// Options of html_check_report().
struct HtmlCheckOptions {
  std::size_t pictures = 24;  ///< Maximum number of close-ups of overlapping pairs, worst first.
  int picture_width = 640;    ///< [pixels]
  int picture_height = 480;   ///< [pixels]
  Executor executor;          ///< Renders pictures in parallel.
  ProgressCallback progress;  ///< Reports and cancels.
};

/// The clash report as a self-contained HTML page, which is also well-formed XML: a sortable and searchable table of
/// the pairs, pictures of the assembly and close-ups of the overlaps. Its content security policy forbids loading
/// anything. Deterministic. Errors: Failed if `progress` cancelled.
Result<std::string> html_check_report(const Assembly& assembly, const Clashes& clashes,
                                      const HtmlCheckOptions& options = {});

}  // namespace dismantle
