// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <string>
#include <utility>

namespace dismantle {

/// Reports OpenCASCADE's progress as one stage.
class StageProgress : public Message_ProgressIndicator {
 public:
  /// @param progress must outlive this
  StageProgress(const ProgressCallback& progress, std::string stage) : progress_(progress), stage_(std::move(stage)) {}

 protected:
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {
    report_progress(progress_, stage_, GetPosition());
  }

 private:
  const ProgressCallback& progress_;
  std::string stage_;
};

}  // namespace dismantle
