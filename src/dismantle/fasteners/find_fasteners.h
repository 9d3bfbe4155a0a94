// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/exec/executor.h"
#include "dismantle/fasteners/fastener.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// The evidence by which fasteners are recognised.
enum class FastenerEvidence : std::uint8_t {
  ShapeAndName,  ///< The shape first; a name decides where shapes are ambiguous, and vetoes: "roller", "lead screw".
  ShapeOnly,     ///< The shape alone.
};

/// The fasteners of an assembly: for each component what it is, nothing for what is none. A heuristic: shapes that are
/// drawn without drive and thread are only recognised by their names. Equal shapes are read once; components of one
/// shape may still differ by their names. Deterministic. Shape [component_count].
/// @param executor runs the shapes; the result does not depend on it
std::vector<std::optional<Fastener>> find_fasteners(const Assembly& assembly, const Executor& executor = {},
                                                    FastenerEvidence evidence = FastenerEvidence::ShapeAndName);

/// Equal fasteners of an assembly.
struct CountedFastener {
  Fastener fastener;                    ///< Of the first of them.
  std::vector<ComponentId> components;  ///< Ascending.
};

/// The fasteners grouped by kind, head, drive and designation, in the order of kinds, then diameter and length.
std::vector<CountedFastener> counted_fasteners(const std::vector<std::optional<Fastener>>& fasteners);

}  // namespace dismantle
