// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/exec/shared_atomics.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// A view of a buffer that kernels append to, on CPU threads and CUDA. Values past the capacity are counted but not
/// stored, so that no loss goes unnoticed. Positions are taken by atomic additions (the global lock of Du et al. 2015,
/// section 4.3).
template <class T>
class AppendView {
 public:
  AppendView() = default;
  /// @param needed counts the values that are appended, stored or not
  DISMANTLE_HOST_DEVICE AppendView(Span<T> storage, std::uint64_t* needed) : storage_(storage), needed_(needed) {}

  /// Appends one value, with one addition (the global lock of the paper).
  DISMANTLE_HOST_DEVICE void append(const T& value) const { put(take(1), value); }

  /// As append(), with one addition for all threads of a warp that append together.
  /// @pre all of these append to the same buffer
  DISMANTLE_HOST_DEVICE void append_together(const T& value) const { put(atomic_count(needed_), value); }

  /// Appends values with one addition.
  void append(Span<const T> values) const {
    if (values.empty()) return;
    const std::size_t first = take(values.size());
    for (std::size_t i = 0; i < values.size() && first + i < storage_.size(); ++i) storage_[first + i] = values[i];
  }

  /// Reserves positions for so many values with one addition; put() fills them. @return the first
  DISMANTLE_HOST_DEVICE std::size_t take(std::size_t count) const { return atomic_add(needed_, count); }
  /// Stores a value at a reserved position, if that is within the capacity.
  DISMANTLE_HOST_DEVICE void put(std::size_t position, const T& value) const {
    if (position < storage_.size()) storage_[position] = value;
  }

 private:
  Span<T> storage_;
  std::uint64_t* needed_ = nullptr;
};

/// How CPU threads append to one stream; the values are the same.
enum class AppendLock : std::uint8_t {
  Local,   ///< Through a buffer of each thread, with one atomic addition when it is full (Tang, Manocha, Lin, Tong
           ///< 2011).
  Global,  ///< One atomic addition for each value (Du et al. 2015, section 4.3, on a GPU).
};

/// Collects up to `kCount` values of one thread and appends them with one addition, so that CPU threads do not contend
/// for the counter's cache line with every value.
template <class T, std::size_t kCount = 64>
class StagedAppend {
 public:
  /// Appends to `target`, at the latest when destroyed; with AppendLock::Global each value at once.
  explicit StagedAppend(AppendView<T> target, AppendLock lock = AppendLock::Local)
      : target_(target), limit_(lock == AppendLock::Global ? 1 : kCount) {}
  StagedAppend(const StagedAppend&) = delete;
  StagedAppend& operator=(const StagedAppend&) = delete;
  ~StagedAppend() { flush(); }

  /// Appends one value.
  void append(const T& value) {
    staged_[count_++] = value;
    if (count_ == limit_) flush();
  }
  /// Passes the collected values on.
  void flush() {
    target_.append(Span<const T>(staged_, count_));
    count_ = 0;
  }

 private:
  AppendView<T> target_;
  std::size_t limit_;
  std::size_t count_ = 0;
  T staged_[kCount];
};

/// Owns the storage of an AppendView. If a kernel overflowed() it, call grow() and run the same kernel again on the
/// same inputs ("grow and replay"), so that no value is lost.
template <class T>
class AppendBuffer {
 public:
  /// Room for `capacity` values, at least one.
  explicit AppendBuffer(std::size_t capacity = 1024) : storage_(capacity > 0 ? capacity : 1) {}

  /// Empties the buffer. @return the view for a kernel to append to
  AppendView<T> start() {
    needed_ = 0;
    return AppendView<T>(Span<T>(storage_), &needed_);
  }
  /// True if values did not fit: they were counted, but not stored.
  bool overflowed() const { return needed() > storage_.size(); }
  /// The number of values that were appended, stored or not.
  std::size_t needed() const { return needed_; }
  /// The number of values that fit.
  std::size_t capacity() const { return storage_.size(); }
  /// Makes room for the values needed and half as many again.
  void grow() { storage_.resize(needed() + needed() / 2); }
  ///@{ The values appended, in no particular order. @pre !overflowed()
  Span<T> values() {
    DISMANTLE_EXPECT(!overflowed());
    return Span<T>(storage_).subspan(0, needed());
  }
  Span<const T> values() const {
    DISMANTLE_EXPECT(!overflowed());
    return Span<const T>(storage_).subspan(0, needed());
  }
  ///@}

 private:
  std::vector<T> storage_;
  std::uint64_t needed_ = 0;
};

/// Calls run(view), and as long as it appended more values than fit, grows the buffer and calls it again.
/// @return the number of calls
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
