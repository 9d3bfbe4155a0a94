// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/usage_error.h"

#include "dismantle/files/similar_names.h"

#include <algorithm>
#include <filesystem>

namespace dismantle::cli {

namespace {

bool is_option(const std::string& argument) {
  return !argument.empty() && argument[0] == '-';
}

/// `text` with another ending, if it ends with `ending`.
std::string with_ending(std::string text, std::string_view ending, std::string_view other) {
  if (text.size() < ending.size() || text.compare(text.size() - ending.size(), ending.size(), ending) != 0) return text;
  text.resize(text.size() - ending.size());
  return text.append(other);
}

/// The names of a command's options, with dashes.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The argument that the command does not take: an unknown option first.
std::string extra_text(const CLI::App& command, const std::string& what, const std::vector<std::string>& arguments) {
  const std::vector<std::string> known = option_names(command);
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (is_option(argument) && !is_known && what.find(argument) != std::string::npos)
      return "there is no option '" + name + "'" + did_you_mean(name, known);
  }
  const std::size_t colon = what.find(": ");
  return "too many arguments: " + (colon == std::string::npos ? what : what.substr(colon + 2));
}

/// The reason of the error, without a full stop.
std::string reason(const CLI::App& command, const CLI::ParseError& error, const std::vector<std::string>& arguments) {
  std::string what = error.what();
  // Not by get_name(), which is the command for some.
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return extra_text(command, what, arguments);
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    return command.get_parent() ? with_ending(what, " is required", " is missing") : "no command is given";
  constexpr std::string_view kConvert = "Could not convert: ", kRequired = " required ", kMissing = " missing";
  if (dynamic_cast<const CLI::ConversionError*>(&error) && what.compare(0, kConvert.size(), kConvert) == 0)
    return "a value is of the wrong kind: " + what.substr(kConvert.size());
  const std::size_t colon = what.find(": "), required = what.find(kRequired);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && colon < required && required != std::string::npos)
    return what.substr(0, colon) + " needs " + with_ending(what.substr(required + kRequired.size()), kMissing, "");
  return what;
}

}  // namespace

std::optional<Error> unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || is_option(arguments[0])) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::string& word = arguments[0];
  if (std::find(names.begin(), names.end(), word) != names.end()) return {};
  std::error_code error;
  std::string advice = did_you_mean(word, names);
  if (advice.empty() && std::filesystem::exists(word, error)) advice = "; 'dismantle view " + word + "' opens it";
  advice += advice.empty() ? "; " : advice.back() == '?' ? " " : ", ";
  return Error{ErrorKind::Usage, "'" + word + "' cannot be run (dismantle has no such command)" + advice +
                                     "'dismantle --help' lists the commands"};
}

Error usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  const CLI::App& command = commands.empty() ? app : *commands.front();
  const std::string name = commands.empty() ? "dismantle" : "dismantle " + command.get_name();
  return {ErrorKind::Usage, "'" + name + "' cannot be run (" + reason(command, error, arguments) + "); '" + name +
                                " --help' shows what it takes"};
}

}  // namespace dismantle::cli
