// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/contract.h"
#include "dismantle/core/host_device.h"

#include <cstdint>
#include <cstring>

namespace dismantle {

/// The parts of a finite double: value = sign * mantissa * 2^exponent.
struct DoubleParts {
  std::uint64_t mantissa = 0;  ///< Below 2^53.
  int exponent = 0;            ///< -1074 to 971.
  int sign = 0;                ///< -1, 0 or 1.
};

/// Splits a double into its parts. @pre x is finite
DISMANTLE_HOST_DEVICE inline DoubleParts parts_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  DISMANTLE_EXPECT(biased != 0x7ff);
  const std::uint64_t fraction = bits & 0xfffffffffffffu;
  DoubleParts parts;
  parts.mantissa = biased == 0 ? fraction : fraction | std::uint64_t{1} << 52;
  parts.exponent = (biased == 0 ? 1 : biased) - 1075;
  parts.sign = x > 0 ? 1 : (x < 0 ? -1 : 0);
  return parts;
}

/// An integer of up to 32 kLimbs bits and a sign, with exact arithmetic. It is slow: for cases in which doubles
/// overflow or underflow.
template <int kLimbs>
struct WideInteger {
  std::uint32_t limb[kLimbs];  ///< The first `size` are set, lowest first; the last of them is not 0.
  int size = 0;                ///< Number of limbs.
  int sign = 0;                ///< -1, 0 or 1; 0 exactly if size is 0.

  /// Drops leading zeros.
  DISMANTLE_HOST_DEVICE void trim() {
    while (size > 0 && limb[size - 1] == 0) --size;
    if (size == 0) sign = 0;
  }
};

/// The integer x / 2^unit_exponent. @pre x is finite; unit_exponent <= parts_of(x).exponent; the quotient has at most
/// 32 kLimbs bits
template <int kLimbs>
DISMANTLE_HOST_DEVICE WideInteger<kLimbs> wide_integer_of(double x, int unit_exponent) {
  const DoubleParts parts = parts_of(x);
  WideInteger<kLimbs> w;
  if (parts.sign == 0) return w;
  const int shift = parts.exponent - unit_exponent;
  w.sign = parts.sign;
  w.size = (shift + 52) / 32 + 1;
  DISMANTLE_EXPECT(shift >= 0 && w.size <= kLimbs);
  for (int i = 0; i < w.size; ++i) w.limb[i] = 0;
  for (int bit = 0; bit < 53; ++bit)
    if (parts.mantissa >> bit & 1) w.limb[(shift + bit) / 32] |= std::uint32_t{1} << (shift + bit) % 32;
  w.trim();
  return w;
}

namespace detail {

/// The sign of |a| - |b|.
template <int kA, int kB>
DISMANTLE_HOST_DEVICE int compare_magnitudes(const WideInteger<kA>& a, const WideInteger<kB>& b) {
  if (a.size != b.size) return a.size > b.size ? 1 : -1;
  for (int i = a.size - 1; i >= 0; --i)
    if (a.limb[i] != b.limb[i]) return a.limb[i] > b.limb[i] ? 1 : -1;
  return 0;
}

/// |a| + b_sign |b| with the sign of a. @param b_sign 1 or -1; if -1, @pre |a| >= |b|
template <int kLimbs>
DISMANTLE_HOST_DEVICE WideInteger<kLimbs> add_magnitudes(const WideInteger<kLimbs>& a, const WideInteger<kLimbs>& b,
                                                         int b_sign) {
  WideInteger<kLimbs> sum;
  sum.sign = a.sign;
  std::int64_t carry = 0;
  const int longer = a.size > b.size ? a.size : b.size;
  for (int i = 0; i < longer || carry != 0; ++i) {
    DISMANTLE_EXPECT(i < kLimbs);
    const std::int64_t of_a = i < a.size ? a.limb[i] : 0, of_b = i < b.size ? b.limb[i] : 0;
    const std::int64_t total = of_a + b_sign * of_b + carry;
    sum.limb[sum.size++] = static_cast<std::uint32_t>(total & 0xffffffff);
    carry = total >> 32;
  }
  sum.trim();
  return sum;
}

}  // namespace detail

/// The negative.
template <int kLimbs>
DISMANTLE_HOST_DEVICE WideInteger<kLimbs> operator-(WideInteger<kLimbs> a) {
  a.sign = -a.sign;
  return a;
}

/// The sum. @pre it has at most 32 kLimbs bits
template <int kLimbs>
DISMANTLE_HOST_DEVICE WideInteger<kLimbs> operator+(const WideInteger<kLimbs>& a, const WideInteger<kLimbs>& b) {
  if (a.sign == 0) return b;
  if (b.sign == 0) return a;
  if (a.sign == b.sign) return detail::add_magnitudes(a, b, 1);
  return detail::compare_magnitudes(a, b) >= 0 ? detail::add_magnitudes(a, b, -1) : detail::add_magnitudes(b, a, -1);
}

/// The difference. @pre it has at most 32 kLimbs bits
template <int kLimbs>
DISMANTLE_HOST_DEVICE WideInteger<kLimbs> operator-(const WideInteger<kLimbs>& a, const WideInteger<kLimbs>& b) {
  return a + -b;
}

/// The product.
template <int kA, int kB>
DISMANTLE_HOST_DEVICE WideInteger<kA + kB> operator*(const WideInteger<kA>& a, const WideInteger<kB>& b) {
  WideInteger<kA + kB> product;
  product.sign = a.sign * b.sign;
  if (product.sign == 0) return product;
  product.size = a.size + b.size;
  for (int i = 0; i < product.size; ++i) product.limb[i] = 0;
  for (int i = 0; i < a.size; ++i) {
    std::uint64_t carry = 0;
    for (int j = 0; j < b.size; ++j) {
      carry += std::uint64_t{a.limb[i]} * b.limb[j] + product.limb[i + j];
      product.limb[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product.limb[i + b.size] = static_cast<std::uint32_t>(carry);
  }
  product.trim();
  return product;
}

}  // namespace dismantle
