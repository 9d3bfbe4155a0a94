// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"

#include <string>
#include <utility>
#include <variant>

namespace dismantle {

/// Where the fault of an Error lies; the command line turns it into its exit code.
enum class ErrorKind {
  Usage,       ///< What was asked for makes no sense (exit code 2).
  Unreadable,  ///< The input cannot be read as what it claims to be (exit code 3).
  Failed,      ///< It went wrong on the way: disk full, out of memory, cancelled (exit code 4).
};

/// What went wrong, in one sentence for the user: "<problem> (<why>); <what to do>".
struct Error {
  ErrorKind kind = ErrorKind::Failed;
  std::string message;
};

/// A value, or the Error that stands in its place. `if (!result) return result.error();`
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: a value is a result
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: an error is a result

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  /// @pre ok()
  T& value() & {
    DISMANTLE_EXPECT(ok());
    return std::get<0>(state_);
  }
  const T& value() const& {
    DISMANTLE_EXPECT(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    DISMANTLE_EXPECT(ok());
    return std::get<0>(std::move(state_));
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  /// @pre !ok()
  const Error& error() const {
    DISMANTLE_EXPECT(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The value of a Result that carries none: done, or the Error.
struct Done {};

}  // namespace dismantle
