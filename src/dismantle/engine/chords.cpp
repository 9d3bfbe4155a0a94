// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/chords.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

int chord_count(double deviation, double max_deviation) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(deviation / max_deviation))));
}

}  // namespace dismantle
