// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/work_steps.h"
#include "dismantle/render/image.h"
#include "dismantle/render/scene.h"

#include <optional>

namespace dismantle {

/// The pictures of a step.
struct StepPictures {
  Image close;                    ///< The moving set, its path and its surroundings.
  std::optional<Image> overview;  ///< All of the surroundings, if `close` shows only a part of them.
  Vec3 view;                      ///< Viewing direction of both; unit vector.
};

/// Renders pictures of work steps: the moving set highlighted at the start of the path, a ghost of it at the end of the
/// section shown, arrows along the path and around axes of rotation. Of the other components only the surroundings of
/// the set are shown; they are transparent if they would hide the set from every side.
class StepPictureRenderer {
 public:
  /// `assembly` must outlive this. @param width, height of the close picture [pixels]
  StepPictureRenderer(const Assembly& assembly, int width, int height, const Executor& executor);

  /// The whole assembly.
  Image cover() const;
  /// The pictures of a step, from the view that shows most of the moving set and of its path. The view of the previous
  /// step is kept if no other is clearly better.
  StepPictures render_step(const WorkStep& step, PathDirection direction);

 private:
  struct Subject;
  Subject subject_of(const WorkStep& step, PathDirection direction) const;
  Vec3 best_view(const Subject& subject) const;
  /// Visible fraction of the moving set's silhouette.
  double visible_share(const Subject& subject, const Vec3& view) const;
  Image render_view(const Subject& subject, const Vec3& view, const std::vector<Vec3>& points, int divisor) const;

  const Assembly& assembly_;
  RenderScene scene_;
  RenderOptions options_;
  Vec3 last_view_;
};

}  // namespace dismantle
