// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dismantle::bench {

/// Exit codes of the benchmarks, as those of the program `dismantle`.
///@{
inline constexpr int kExitFailed = 1;      ///< A result is not what it must be.
inline constexpr int kExitUsage = 2;       ///< Wrong command line.
inline constexpr int kExitUnreadable = 3;  ///< Unreadable input.
///@}

/// Parser of a benchmark's command line: options with a value ("--steps 60"), flags ("--no-audit") and words.
/// Variables that the command line does not mention keep their values, which are the defaults.
class CommandLine {
 public:
  /// @param usage printed after "usage: " where the command line is wrong
  explicit CommandLine(std::string usage) : usage_(std::move(usage)) {}

  /// An option with a whole number of at least `min`.
  template <class Integer>
  void option(const std::string& name, Integer& value, std::type_identity_t<Integer> min) {
    set_by_name_[name] = [&value, min](const std::string& text) { return parse_number(text, value) && value >= min; };
  }
  /// An option with a decimal number.
  void option(const std::string& name, double& value) {
    set_by_name_[name] = [&value](const std::string& text) {
      char* end = nullptr;
      value = std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0';
    };
  }
  /// An option with any text.
  void option(const std::string& name, std::string& value) {
    set_by_name_[name] = [&value](const std::string& text) {
      value = text;
      return true;
    };
  }
  /// An option with one of some names.
  template <class Value>
  void choice(const std::string& name, Value& value, std::map<std::string, std::type_identity_t<Value>> values) {
    set_by_name_[name] = [&value, values = std::move(values)](const std::string& text) {
      const auto found = values.find(text);
      if (found == values.end()) return false;
      value = found->second;
      return true;
    };
  }
  /// An option that may be given several times, each with one of some names.
  template <class Value>
  void choices(const std::string& name, std::vector<Value>& chosen,
               std::map<std::string, std::type_identity_t<Value>> values) {
    set_by_name_[name] = [&chosen, values = std::move(values)](const std::string& text) {
      const auto found = values.find(text);
      if (found == values.end()) return false;
      chosen.push_back(found->second);
      return true;
    };
  }
  /// An option that may be given several times, each with a whole number above 0.
  void numbers(const std::string& name, std::vector<int>& numbers) {
    set_by_name_[name] = [&numbers](const std::string& text) {
      return parse_number(text, numbers.emplace_back()) && numbers.back() > 0;
    };
  }
  /// An option without a value: sets `flag` to true.
  void flag(const std::string& name, bool& flag) { flags_[name] = &flag; }
  /// Positional arguments. @param allowed the permitted words; empty: any
  void words(std::vector<std::string>& words, std::vector<std::string> allowed = {}) {
    add_word_ = [&words, allowed = std::move(allowed)](const std::string& text) {
      words.push_back(text);
      return allowed.empty() || std::find(allowed.begin(), allowed.end(), text) != allowed.end();
    };
  }
  /// Positional arguments that are whole numbers above 0; they replace the defaults in `numbers`.
  template <class Integer>
  void numbers(std::vector<Integer>& numbers) {
    add_word_ = [&numbers, first = true](const std::string& text) mutable {
      if (std::exchange(first, false)) numbers.clear();
      return parse_number(text, numbers.emplace_back()) && numbers.back() > 0;
    };
  }

  /// Sets the variables from argv[first] on.
  /// @return false where the command line is wrong: the usage is printed then, and the program ends with kExitUsage
  bool parse(int argc, char** argv, int first = 1) const {
    for (int i = first; i < argc; ++i) {
      const std::string text = argv[i];
      if (const auto flag = flags_.find(text); flag != flags_.end()) {
        *flag->second = true;
      } else if (const auto option = set_by_name_.find(text); option != set_by_name_.end()) {
        if (++i == argc || !option->second(argv[i])) return wrong();
      } else if (text.rfind("--", 0) == 0 || !add_word_ || !add_word_(text)) {
        return wrong();
      }
    }
    return true;
  }
  /// Prints the usage on stderr. @return false
  bool wrong() const {
    std::fprintf(stderr, "usage: %s\n", usage_.c_str());
    return false;
  }

 private:
  using Set = std::function<bool(const std::string& text)>;

  template <class Integer>
  static bool parse_number(const std::string& text, Integer& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  }

  std::string usage_;
  std::map<std::string, Set> set_by_name_;
  std::map<std::string, bool*> flags_;
  Set add_word_;
};

}  // namespace dismantle::bench
