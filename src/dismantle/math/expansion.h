// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

namespace dismantle {

/// Exact arithmetic on sums of doubles, after Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
/// Geometric Predicates", 1997. Needs IEEE doubles rounded to nearest even and no contraction. Everything here is exact
/// as long as no operation overflows and no product has a bit below 2^-1074: see each function's @pre.

/// The exact result of an operation as a sum of two doubles.
struct TwoTerms {
  double high = 0;  ///< The double nearest to the result.
  double low = 0;   ///< The rest.
};

/// a + b exactly (Knuth; Shewchuk, theorem 7). @pre the sum does not overflow
DISMANTLE_HOST_DEVICE inline TwoTerms two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a + b exactly (Dekker; Shewchuk, theorem 6). @pre |a| >= |b| or a is 0, and the sum does not overflow
DISMANTLE_HOST_DEVICE inline TwoTerms fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a - b exactly. @pre the difference does not overflow
DISMANTLE_HOST_DEVICE inline TwoTerms two_difference(double a, double b) {
  return two_sum(a, -b);
}

/// `a` as two halves of at most 26 bits (Veltkamp; Shewchuk, theorem 17). @pre |a| < 2^996
DISMANTLE_HOST_DEVICE inline TwoTerms split_in_halves(double a) {
  constexpr double kSplitter = 0x1p27 + 1;
  const double large = kSplitter * a;
  const double high = large - (large - a);
  return {high, a - high};
}

/// a * b exactly (Dekker; Shewchuk, theorem 18). @pre |a|, |b| < 2^996; |a b| < 2^1023; the product of the lowest set
/// bits of a and b is at least 2^-1074
DISMANTLE_HOST_DEVICE inline TwoTerms two_product(double a, double b) {
  const double product = a * b;
  const TwoTerms p = split_in_halves(a), q = split_in_halves(b);
  const double error = ((product - p.high * q.high) - p.low * q.high) - p.high * q.low;
  return {product, p.low * q.low - error};
}

/// An exact sum of up to kCapacity doubles: strongly nonoverlapping, ascending in magnitude, without zeros.
template <int kCapacity>
struct Expansion {
  double term[kCapacity];  ///< The first `size` are set.
  int size = 0;            ///< Number of terms; 0 for the value 0.

  /// Adds a term of larger magnitude than all others, unless it is 0.
  DISMANTLE_HOST_DEVICE void append_if_nonzero(double t) {
    if (t != 0) term[size++] = t;
  }
  /// -1, 0 or 1; exact.
  DISMANTLE_HOST_DEVICE int sign() const { return size == 0 ? 0 : (term[size - 1] > 0 ? 1 : -1); }
  /// The value with a relative error of at most 2u, u = 2^-53 (Shewchuk, section 2.8).
  DISMANTLE_HOST_DEVICE double estimate() const {
    double sum = 0;
    for (int i = 0; i < size; ++i) sum += term[i];
    return sum;
  }
};

/// The same number as an expansion.
DISMANTLE_HOST_DEVICE inline Expansion<2> expansion_of(TwoTerms t) {
  Expansion<2> e;
  e.append_if_nonzero(t.low);
  e.append_if_nonzero(t.high);
  return e;
}

/// Exact.
template <int kCapacity>
DISMANTLE_HOST_DEVICE Expansion<kCapacity> operator-(Expansion<kCapacity> e) {
  for (int i = 0; i < e.size; ++i) e.term[i] = -e.term[i];
  return e;
}

/// Exact (FAST-EXPANSION-SUM with zero elimination; Shewchuk, theorem 13).
template <int kE, int kF>
DISMANTLE_HOST_DEVICE Expansion<kE + kF> operator+(const Expansion<kE>& e, const Expansion<kF>& f) {
  Expansion<kE + kF> h;
  double carry = 0;
  for (int i = 0, j = 0; i < e.size || j < f.size;) {
    const bool from_e = j == f.size || (i < e.size && (e.term[i] < 0 ? -e.term[i] : e.term[i]) <
                                                          (f.term[j] < 0 ? -f.term[j] : f.term[j]));
    const TwoTerms sum = two_sum(carry, from_e ? e.term[i++] : f.term[j++]);
    h.append_if_nonzero(sum.low);
    carry = sum.high;
  }
  h.append_if_nonzero(carry);
  return h;
}

/// Exact (SCALE-EXPANSION with zero elimination; Shewchuk, theorem 19). @pre as for two_product, of every term and b
template <int kE>
DISMANTLE_HOST_DEVICE Expansion<2 * kE> operator*(const Expansion<kE>& e, double b) {
  Expansion<2 * kE> h;
  double carry = 0;
  for (int i = 0; i < e.size; ++i) {
    const TwoTerms product = two_product(e.term[i], b);
    const TwoTerms sum = two_sum(carry, product.low);
    h.append_if_nonzero(sum.low);
    const TwoTerms upper = fast_two_sum(product.high, sum.high);
    h.append_if_nonzero(upper.low);
    carry = upper.high;
  }
  h.append_if_nonzero(carry);
  return h;
}

/// Exact. @pre as for two_product, of every term of e and every term of f
template <int kE>
DISMANTLE_HOST_DEVICE Expansion<4 * kE> operator*(const Expansion<kE>& e, const Expansion<2>& f) {
  return e * (f.size > 0 ? f.term[0] : 0.0) + e * (f.size > 1 ? f.term[1] : 0.0);
}

}  // namespace dismantle
