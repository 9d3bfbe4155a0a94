// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/exec/shared_atomics.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// What a kernel appends to: writes past the capacity are counted but not stored, so that nothing is lost unnoticed.
/// The position is taken by one atomic addition (the paper's global lock, section 4.3). The same on CPU threads and
/// CUDA.
template <class T>
class AppendView {
 public:
  AppendView() = default;
  /// @param needed counts what is appended, kept or not
  DISMANTLE_HOST_DEVICE AppendView(Span<T> storage, std::uint64_t* needed) : storage_(storage), needed_(needed) {}

  DISMANTLE_HOST_DEVICE void append(const T& value) const { put(take(1), value); }

  /// Appends all the values with one addition.
  void append(Span<const T> values) const {
    if (values.empty()) return;
    const std::size_t place = take(values.size());
    for (std::size_t i = 0; i < values.size() && place + i < storage_.size(); ++i) storage_[place + i] = values[i];
  }

  /// Takes places for so many values with one addition, and gives the first; put() fills them.
  DISMANTLE_HOST_DEVICE std::size_t take(std::size_t count) const { return atomic_add(needed_, count); }
  DISMANTLE_HOST_DEVICE void put(std::size_t place, const T& value) const {
    if (place < storage_.size()) storage_[place] = value;
  }

 private:
  Span<T> storage_;
  std::uint64_t* needed_ = nullptr;
};

/// Collects up to `kCount` values of one thread before it appends them with one addition: on CPU threads the counter's
/// cache line would otherwise travel with every value.
template <class T, std::size_t kCount = 64>
class StagedAppend {
 public:
  explicit StagedAppend(AppendView<T> target) : target_(target) {}
  StagedAppend(const StagedAppend&) = delete;
  StagedAppend& operator=(const StagedAppend&) = delete;
  ~StagedAppend() { flush(); }

  void append(const T& value) {
    if (count_ == kCount) flush();
    staged_[count_++] = value;
  }
  void flush() {
    target_.append(Span<const T>(staged_, count_));
    count_ = 0;
  }

 private:
  AppendView<T> target_;
  std::size_t count_ = 0;
  T staged_[kCount];
};

/// Owns the storage of an AppendView. After the kernel: if overflowed(), call grow() and run the same kernel again from
/// the same inputs ("grow and replay"): no value is ever lost.
template <class T>
class AppendBuffer {
 public:
  explicit AppendBuffer(std::size_t capacity = 1024) : storage_(capacity > 0 ? capacity : 1) {}

  /// Empties the buffer and gives the view for a kernel to append to.
  AppendView<T> start() {
    needed_ = 0;
    return AppendView<T>(Span<T>(storage_), &needed_);
  }
  /// True where values did not fit: they were counted, but not kept.
  bool overflowed() const { return needed() > storage_.size(); }
  /// How many values were appended, kept or not.
  std::size_t needed() const { return needed_; }
  std::size_t capacity() const { return storage_.size(); }
  /// Makes room for what was needed, and half as much again.
  void grow() { storage_.resize(needed() + needed() / 2); }
  /// The values appended, in no particular order. @pre !overflowed()
  Span<T> values() {
    DISMANTLE_EXPECT(!overflowed());
    return Span<T>(storage_).subspan(0, needed());
  }
  Span<const T> values() const {
    DISMANTLE_EXPECT(!overflowed());
    return Span<const T>(storage_).subspan(0, needed());
  }

 private:
  std::vector<T> storage_;
  std::uint64_t needed_ = 0;
};

/// Runs `kernel(view)` and, as long as it appended more than there was room for, grows the buffer and runs it again.
/// @return how many runs it took
template <class T, class Run>
int append_with_replay(AppendBuffer<T>& buffer, const Run& run) {
  int runs = 1;
  run(buffer.start());
  while (buffer.overflowed()) {
    buffer.grow();
    run(buffer.start());
    ++runs;
  }
  return runs;
}

}  // namespace dismantle
