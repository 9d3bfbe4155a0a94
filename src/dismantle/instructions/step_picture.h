// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/work_steps.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

#include <optional>

namespace dismantle {

/// The pictures of a step.
struct StepPictures {
  Image close;                    ///< What moves, its way, and what is around it.
  std::optional<Image> overview;  ///< All that it is taken from, where `close` shows only a part.
  Vec3 view;                      ///< In which direction both look; unit.
};

/// Takes pictures of work steps: what moves in a colour of its own near where it belongs, a ghost on the other end of
/// the stretch shown, arrows along the way and around axes that it turns about. What a set is taken from is shown,
/// nothing that lies elsewhere; where that hides the set from all sides, it is looked through.
class StepPictureTaker {
 public:
  /// The assembly must outlive this. @param width, height of the close picture [pixels]
  StepPictureTaker(const Assembly& assembly, int width, int height, const Executor& executor);

  /// The whole assembly.
  Image cover() const;
  /// Pictures of a step from the view that shows most of what moves and of its way; of views that are about as good the
  /// one of the step before, so that a reader need not turn the assembly in mind.
  StepPictures take(const WorkStep& step, PathDirection direction);

 private:
  struct Subject;
  Subject subject_of(const WorkStep& step, PathDirection direction) const;
  Vec3 best_view(const Subject& subject) const;
  /// How much of what could be seen of the moving set is.
  double seen_share(const Subject& subject, const Vec3& view) const;
  Image take(const Subject& subject, const Vec3& view, const std::vector<Vec3>& points, int divisor) const;

  const Assembly& assembly_;
  RenderScene scene_;
  RenderOptions options_;
  Vec3 last_view_;
};

}  // namespace dismantle
