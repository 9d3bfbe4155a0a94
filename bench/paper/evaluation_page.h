// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/paper/evaluation.h"

#include <string>

namespace dismantle {

/// Where and how an evaluation was made.
struct EvaluationSetting {
  std::string date, processor, compiler, command;
  std::string gpu;  ///< The CUDA device's name; empty where nothing ran on one.
  int cores = 1;
  double load_before = 0, load_after = 0;  ///< Average over a minute.
};

/// This machine, now, with nothing measured yet. @param command as the user gave it
EvaluationSetting present_setting(const std::string& command, int cores);
/// The machine's load, averaged over a minute.
double present_load();

/// The page docs/evaluation.md: all that was measured, and in words what it is.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationSetting& setting);

/// A file of the evaluation, its path under docs.
struct EvaluationFile {
  std::string path, text;
};

/// The page, its pictures and its tables as CSV.
std::vector<EvaluationFile> evaluation_files(const Evaluation& evaluation, const EvaluationSetting& setting);

}  // namespace dismantle
