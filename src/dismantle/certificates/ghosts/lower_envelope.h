// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <vector>

namespace dismantle {

/// A segment over an interval of x.
struct GraphSegment {
  double x0 = 0;  ///< Begin of the interval.
  double y0 = 0;  ///< The segment's y there.
  double x1 = 0;  ///< End of the interval; above x0.
  double y1 = 0;  ///< The segment's y there.

  /// Its y at `x`, which is moved into the interval.
  double at(double x) const;
  friend bool operator==(const GraphSegment&, const GraphSegment&) = default;
};

/// The lower envelope of segments: where they are the lowest ones, up to rounding. Takes n log n for n segments.
/// @param segments x0 < x1 for each
/// @return parts of segments, by x; they share no more than ends, and leave out only what no segment is over
std::vector<GraphSegment> lower_envelope(Span<const GraphSegment> segments);

}  // namespace dismantle
