// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/exec/executor.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"
#include "dismantle/report/intersection_curve.h"

#include <vector>

namespace dismantle {

inline constexpr Color kFirstColor{0.93f, 0.66f, 0.25f};           ///< Colour of a pair's first component.
inline constexpr Color kSecondColor{0.36f, 0.58f, 0.86f};          ///< Colour of a pair's second component.
inline constexpr Color kOverlapColor{0.85f, 0.02f, 0.10f, 0.75f};  ///< Colour of their overlap.

/// Renders the pictures of a clash report; prepares the assembly once.
class CheckPictures {
 public:
  /// `assembly` must outlive this. @param width, height of each picture [pixels]
  CheckPictures(const Assembly& assembly, int width, int height, const Executor& executor);

  /// The whole assembly in its own colours.
  Image overview() const;
  /// The whole assembly, transparent, with the intersection curves of the given pairs.
  Image overlaps(const std::vector<Clash>& pairs) const;
  /// A close-up of the overlap of a pair: the two components highlighted, all others transparent, their common volume,
  /// their intersection curve and the deepest point marked.
  Image closeup(const Clash& pair) const;

 private:
  Image picture(const RenderScene& scene, const std::vector<Vec3>& points) const;
  std::vector<CurveSegment> curve(const Clash& pair) const;

  const Assembly& assembly_;
  RenderScene scene_;
  RenderOptions options_;
};

}  // namespace dismantle
