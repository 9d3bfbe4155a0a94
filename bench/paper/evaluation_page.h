// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/evaluation.h"

#include <string>

namespace dismantle {

/// Machine, date and command of an evaluation.
struct EvaluationSetting {
  std::string date, processor, compiler, command;
  std::string gpu;  ///< The CUDA device's name; empty where nothing ran on one.
  int cores = 1;
  double load_before = 0, load_after = 0;  ///< Of the machine, averaged over a minute.
};

/// This machine and its load now; load_after is not set. @param command as the user gave it
EvaluationSetting present_setting(const std::string& command, int cores);
/// The load of the machine now, averaged over a minute.
double present_load();

/// The text of the page docs/evaluation.md.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationSetting& setting);

/// A file of the evaluation. The path is relative to docs.
struct EvaluationFile {
  std::string path, text;
};

/// The tables as CSV, the pictures, and at last the page.
std::vector<EvaluationFile> evaluation_files(const Evaluation& evaluation, const EvaluationSetting& setting);

}  // namespace dismantle
