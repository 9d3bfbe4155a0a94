// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Validators of option values. Unlike those of CLI11, they add nothing to the help (the type's name lists the values),
/// and their messages are parts of sentences: "'parsec' is not one of mm, cm or m".
namespace dismantle::cli {

/// Accepts one of these words.
CLI::Validator one_of(std::vector<std::string> words);
/// Accepts numbers above 0.
CLI::Validator above_zero();
/// Accepts numbers from 0.
CLI::Validator not_negative();
/// Accepts numbers from `min` to `max`.
CLI::Validator between(double min, double max);
/// Accepts folders that exist.
CLI::Validator existing_folder();

/// The words for a sentence: "mm, cm or m".
std::string list_of(const std::vector<std::string>& words);

/// Accepts the names of the values of an enumeration, which it gives to the option.
template <class T>
CLI::Validator choice(const std::map<std::string, T>& values) {
  static_assert(std::is_enum_v<T>);
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto& value : values) names.push_back(value.first);
  const CLI::Validator is_name = one_of(std::move(names));
  return CLI::Validator(
      [values, is_name](std::string& text) {
        std::string error = is_name(text);
        if (error.empty()) text = std::to_string(static_cast<std::underlying_type_t<T>>(values.at(text)));
        return error;
      },
      "");
}

}  // namespace dismantle::cli
