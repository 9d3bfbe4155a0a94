// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"

#include <string>
#include <utility>
#include <variant>

namespace dismantle {

/// The class of an Error, which gives the command line's exit code.
enum class ErrorKind {
  Usage,       ///< The request makes no sense (exit code 2).
  Unreadable,  ///< The input is not what it claims to be (exit code 3).
  Failed,      ///< The work failed or was cancelled: disk full, out of memory (exit code 4).
};

/// An error for the user.
struct Error {
  ErrorKind kind = ErrorKind::Failed;  ///< Gives the exit code.
  std::string message;                 ///< One sentence: "<problem> (<why>); <what to do>".
};

/// A value or an Error. `if (!result) return result.error();`
template <class T>
class [[nodiscard]] Result {
 public:
  /// A success.
  Result(T value) : state_(std::move(value)) {}  // NOLINT: a value is a result
  /// A failure.
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: an error is a result

  /// True if there is a value.
  bool ok() const { return state_.index() == 0; }
  /// As ok().
  explicit operator bool() const { return ok(); }
  ///@{ The value. @pre ok()
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
  ///@}
  /// The error. @pre !ok()
  const Error& error() const {
    DISMANTLE_EXPECT(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The value of a Result that carries none, as in Result<Done>.
struct Done {};

}  // namespace dismantle
