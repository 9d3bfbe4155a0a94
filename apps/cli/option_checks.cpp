// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/option_checks.h"

#include "dismantle/files/number_text.h"
#include "dismantle/files/similar_names.h"
#include "dismantle/files/text_scan.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

namespace dismantle::cli {

namespace {

CLI::Validator number_that(std::function<bool(double)> holds, const std::string& what) {
  return CLI::Validator(
      [holds = std::move(holds), what](std::string& text) {
        const std::optional<double> number = to_double(text);
        return number && holds(*number) ? std::string() : "'" + text + "' is not a number " + what;
      },
      "");
}

}  // namespace

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::Validator(
      [words = std::move(words)](std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
        const std::vector<std::string> meant = similar_names(text, words, 1);
        return "'" + text + "' is not one of " + list_of(words) + (meant.empty() ? "" : ": perhaps " + meant[0]);
      },
      "");
}

CLI::Validator above_zero() {
  return number_that([](double x) { return x > 0; }, "above 0");
}

CLI::Validator not_negative() {
  return number_that([](double x) { return x >= 0; }, "from 0");
}

CLI::Validator between(double min, double max) {
  return number_that([min, max](double x) { return x >= min && x <= max; },
                     "from " + number_text(min, 17) + " to " + number_text(max, 17));
}

CLI::Validator existing_folder() {
  return CLI::Validator(
      [](std::string& text) {
        std::error_code error;
        return std::filesystem::is_directory(text, error) ? std::string() : "there is no folder '" + text + "'";
      },
      "");
}

}  // namespace dismantle::cli
