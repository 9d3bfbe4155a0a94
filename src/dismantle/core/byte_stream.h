// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace dismantle {

/// Receives the next piece of a byte stream.
using ByteSink = std::function<void(const void* data, std::size_t size)>;

/// Writes values in native byte order.
class ByteWriter {
 public:
  /// @param sink must outlive this
  explicit ByteWriter(const ByteSink& sink) : sink_(sink) {}

  /// Writes the bytes of a value.
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    sink_(&v, sizeof v);
  }
  /// Writes the number of values, and their bytes.
  template <class T>
  void array(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value<std::uint64_t>(values.size());
    if (!values.empty()) sink_(values.data(), values.size() * sizeof(T));
  }
  /// As array(), of characters.
  void text(const std::string& s) { array(std::vector<char>(s.begin(), s.end())); }

 private:
  const ByteSink& sink_;
};

/// Reads the bytes back; after a truncated piece all values are empty and ok() is false.
class ByteReader {
 public:
  /// @param bytes must outlive this
  explicit ByteReader(Span<const std::byte> bytes) : bytes_(bytes) {}

  /// False as soon as something was missing.
  bool ok() const { return ok_; }
  /// True if everything was read.
  bool at_end() const { return offset_ == bytes_.size(); }
  /// Number of bytes that are left.
  std::size_t left() const { return bytes_.size() - offset_; }

  /// A value, as ByteWriter::value() wrote it.
  template <class T>
  T value() {
    T v{};
    if (sizeof v > left()) {
      ok_ = false;
      return v;
    }
    std::memcpy(&v, bytes_.data() + offset_, sizeof v);
    offset_ += sizeof v;
    return v;
  }
  /// A count of items of at least `min_size` bytes each.
  std::size_t count(std::size_t min_size) {
    const auto n = value<std::uint64_t>();
    if (n > left() / min_size) ok_ = false;
    return ok_ ? static_cast<std::size_t>(n) : 0;
  }
  /// The values that ByteWriter::array() wrote.
  template <class T>
  std::vector<T> array() {
    std::vector<T> values(count(sizeof(T)));
    if (!values.empty()) std::memcpy(values.data(), bytes_.data() + offset_, values.size() * sizeof(T));
    offset_ += values.size() * sizeof(T);
    return values;
  }
  /// The text that ByteWriter::text() wrote.
  std::string text() {
    const std::vector<char> characters = array<char>();
    return {characters.begin(), characters.end()};
  }

 private:
  Span<const std::byte> bytes_;
  std::size_t offset_ = 0;
  bool ok_ = true;
};

}  // namespace dismantle
