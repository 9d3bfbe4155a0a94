// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/core/host_device.h"

#include <cstddef>
#include <type_traits>
#include <vector>

namespace dismantle {

/// A view of contiguous values, in host and device code. The values must outlive it.
template <class T>
class Span {
 public:
  /// No values.
  Span() = default;
  /// The `size` values from `data` on.
  DISMANTLE_HOST_DEVICE Span(T* data, std::size_t size) : data_(data), size_(size) {}
  /// A view of non-const values as one of const values.
  template <class U>
  requires std::is_convertible_v<U (*)[], T (*)[]> DISMANTLE_HOST_DEVICE Span(Span<U> other)
      : data_(other.data()), size_(other.size()) {}  // NOLINT: a view converts
  ///@{ The values of a vector.
  template <class U>
  requires std::is_convertible_v<U (*)[], T (*)[]> Span(std::vector<U>& values)
      : data_(values.data()), size_(values.size()) {}  // NOLINT: a view converts
  template <class U>
  requires std::is_convertible_v<const U (*)[], T (*)[]> Span(const std::vector<U>& values)
      : data_(values.data()), size_(values.size()) {}  // NOLINT: a view converts
  ///@}

  /// The value at index `i`. @pre i < size()
  DISMANTLE_HOST_DEVICE T& operator[](std::size_t i) const {
    DISMANTLE_EXPECT(i < size_);
    return data_[i];
  }
  ///@{ As std::span.
  DISMANTLE_HOST_DEVICE T* data() const { return data_; }
  DISMANTLE_HOST_DEVICE std::size_t size() const { return size_; }
  DISMANTLE_HOST_DEVICE bool empty() const { return size_ == 0; }
  DISMANTLE_HOST_DEVICE T* begin() const { return data_; }
  DISMANTLE_HOST_DEVICE T* end() const { return data_ + size_; }
  ///@}
  /// The `count` values from `offset` on. @pre offset + count <= size()
  DISMANTLE_HOST_DEVICE Span subspan(std::size_t offset, std::size_t count) const {
    DISMANTLE_EXPECT(offset + count <= size_);
    return Span(data_ + offset, count);
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace dismantle
