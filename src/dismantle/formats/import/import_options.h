// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <cstddef>
#include <string>

namespace dismantle {

/// What a reader may use up before it gives in with an Error; the defaults are far above real assemblies.
struct ImportLimits {
  std::size_t file_bytes = std::size_t{4} << 30;  ///< Larger files are refused.
  std::size_t triangles = 50'000'000;             ///< Of the whole assembly.
  std::size_t components = 100'000;
};

/// Options of every reader.
struct ImportOptions {
  std::string units;  ///< "mm", "cm", "m", "um", "in", "ft": overrides what the file says; empty: as the file says, mm
                      ///< where it does not.
  double deflection = 0;  ///< STEP: largest distance of a triangle from its surface [mm]; 0: kDefaultRelativeDeflection
                          ///< of the assembly's size.
  double angular_deflection =
      0;  ///< STEP: largest turn of the normal from facet to facet [rad]; 0: kDefaultAngularDeflection.
  ImportLimits limits;
  ProgressCallback progress;
};

}  // namespace dismantle
