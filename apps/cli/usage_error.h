// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace dismantle::cli {

/// The error if the first argument names no command, with the commands of a similar name; none if it is a command or
/// an option of the program. @param arguments without the program's name
std::optional<Error> unknown_command(const CLI::App& app, const std::vector<std::string>& arguments);

/// An error of CLI11 as one sentence in the form of all errors. @pre app.parse() threw `error`
/// @param arguments without the program's name
Error usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments);

}  // namespace dismantle::cli
