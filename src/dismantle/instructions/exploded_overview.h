// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/documents/bill_of_materials.h"
#include "dismantle/exec/executor.h"
#include "dismantle/render/image.h"

#include <vector>

namespace dismantle {

/// A point of a picture, in fractions of its width and height from the upper left corner.
struct PicturePoint {
  double x = 0;  ///< To the right.
  double y = 0;  ///< Downwards.
};

/// A mark that binds a component in a picture to its line of the parts list.
struct Balloon {
  std::size_t item = 0;  ///< Line of the parts list, from 0.
  PicturePoint anchor;   ///< On the component.
  PicturePoint place;    ///< Centre of the balloon, beside the components.
};

/// An exploded view with its balloons.
struct ExplodedOverview {
  Image picture;                  ///< Without the balloons.
  std::vector<Balloon> balloons;  ///< Ordered by side (left first) and from top to bottom.
};

/// Renders all components moved away from the centre of the assembly, which is no way of taking it apart. The component
/// of each item that is visible best has the balloon; balloons are in two columns, so that their leaders do not cross
/// within a column. Beyond kMaxBalloons items the smallest have none. Deterministic.
/// @param bill with a line for every component @param width, height [pixels]
ExplodedOverview exploded_overview(const Assembly& assembly, const std::vector<BillItem>& bill, int width, int height,
                                   const Executor& executor);

/// Largest number of balloons in a picture: more are not legible.
inline constexpr std::size_t kMaxBalloons = 40;

}  // namespace dismantle
