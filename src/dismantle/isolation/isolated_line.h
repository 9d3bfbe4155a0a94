// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// What a child process tells its parent, in the order of writing: messages of a kind (one byte), the length of their
/// payload (eight bytes, native order), and the payload.
enum class LineMessage : std::uint8_t {
  Report = 1,   ///< The fraction (a double), then the stage.
  Bytes = 2,    ///< A piece of the result.
  Refusal = 3,  ///< The ErrorKind (one byte), then the message.
  End = 4,      ///< The result is whole.
};

/// The child's end of the message channel to its parent. Thread-safe. Ends the process where the parent no longer
/// reads.
class IsolatedLine {
 public:
  /// A channel that writes to an open file descriptor, which the caller keeps open.
  explicit IsolatedLine(int descriptor) : descriptor_(descriptor) {}

  /// Tells the parent what the child is doing and how far it is (0 to 1; below 0 where unknown). Frequent reports of
  /// one stage are thinned out.
  void report(std::string_view stage, double fraction);
  /// Appends to the result bytes that the parent receives.
  void write(const void* data, std::size_t size);
  /// Sends the Error that the parent is to return.
  void refuse(const Error& error);
  /// Marks the result as complete; run_isolated_child calls it when the work returns.
  void finish();

 private:
  void send(LineMessage kind, const void* data, std::size_t size);

  int descriptor_;
  std::mutex mutex_;
  std::string last_stage_;
  double last_report_ = -1;  ///< [s], of a monotonic clock
};

/// The parent's end: takes the messages apart as their bytes arrive. What it is given may be hostile.
class IsolatedLineReader {
 public:
  /// Takes the next bytes. False if a message is malformed.
  bool take(const std::byte* data, std::size_t size);

  /// True once the child has said that its result is whole.
  bool ended() const { return ended_; }
  /// True once the child has sent an Error.
  bool refused() const { return refused_; }
  /// That Error.
  const Error& error() const { return error_; }
  /// The result so far.
  std::vector<std::byte>& bytes() { return bytes_; }
  /// What the child is doing.
  const std::string& stage() const { return stage_; }
  /// How far it is; see IsolatedLine::report().
  double fraction() const { return fraction_; }

 private:
  bool take_message(std::uint8_t kind, const std::byte* payload, std::size_t length);

  std::vector<std::byte> pending_, bytes_;
  Error error_;
  std::string stage_ = "starting";
  double fraction_ = -1;
  bool ended_ = false, refused_ = false;
};

}  // namespace dismantle
