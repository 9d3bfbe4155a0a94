// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <cstring>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// The operations that math/lanes.h is built on: a register of floats, a mask and their operations, one struct a count.

/// The namespace of lanes and kernels, named after the instructions that a source is compiled for.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define DISMANTLE_LANES_ISA lanes_avx512
#elif defined(__AVX2__)
#define DISMANTLE_LANES_ISA lanes_avx2
#else
#define DISMANTLE_LANES_ISA lanes_plain
#endif

namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// Four floats in the compiler's vectors, on any machine.
struct PortableLaneOperations {
  static constexpr int kCount = 4;  ///< Lanes.
  ///@{ A register, a mask and the operations on them, lane by lane; Lanes and LaneMask say what they do.
  typedef float Register __attribute__((vector_size(16)));
  typedef int Mask __attribute__((vector_size(16)));

  static Register load(const float* from) {
    Register r;
    std::memcpy(&r, from, sizeof r);
    return r;
  }
  static void store(float* to, Register r) { std::memcpy(to, &r, sizeof r); }
  static Register broadcast(float x) {
    Register r;
    for (int i = 0; i < kCount; ++i) r[i] = x;
    return r;
  }
  static Register min(Register a, Register b) { return a < b ? a : b; }
  static Register max(Register a, Register b) { return a > b ? a : b; }
  static Register abs(Register a) { return reinterpret_cast<Register>(reinterpret_cast<Mask>(a) & 0x7fffffff); }
  static Register sqrt(Register a) {
    for (int i = 0; i < kCount; ++i) a[i] = __builtin_sqrtf(a[i]);
    return a;
  }
  static Mask less(Register a, Register b) { return a < b; }
  static Mask less_or_equal(Register a, Register b) { return a <= b; }
  static Mask equal(Register a, Register b) { return a == b; }
  static Register select(Mask m, Register a, Register b) { return m ? a : b; }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask inverse(Mask a) { return ~a; }
  static unsigned bits(Mask m) {
    unsigned all = 0;
    for (int i = 0; i < kCount; ++i) all |= (static_cast<unsigned>(m[i]) & 1u) << i;
    return all;
  }
  ///@}
};

/// The operations of the machine on kCount floats, with the members of PortableLaneOperations.
template <int kCount>
struct LaneOperations;

/// One float: the only count that device code has, too.
template <>
struct LaneOperations<1> {
  ///@{ As PortableLaneOperations.
  using Register = float;
  using Mask = bool;

  DISMANTLE_HOST_DEVICE static Register load(const float* from) { return *from; }
  DISMANTLE_HOST_DEVICE static void store(float* to, Register r) { *to = r; }
  DISMANTLE_HOST_DEVICE static Register broadcast(float x) { return x; }
  DISMANTLE_HOST_DEVICE static Register min(Register a, Register b) { return a < b ? a : b; }
  DISMANTLE_HOST_DEVICE static Register max(Register a, Register b) { return a > b ? a : b; }
#if defined(__CUDA_ARCH__)
  __device__ static Register abs(Register a) {
    return ::fabsf(a);
  }
  __device__ static Register sqrt(Register a) {
    return ::sqrtf(a);
  }
#else
  DISMANTLE_HOST_DEVICE static Register abs(Register a) {
    return __builtin_fabsf(a);
  }
  DISMANTLE_HOST_DEVICE static Register sqrt(Register a) {
    return __builtin_sqrtf(a);
  }
#endif
  DISMANTLE_HOST_DEVICE static Mask less(Register a, Register b) {
    return a < b;
  }
  DISMANTLE_HOST_DEVICE static Mask less_or_equal(Register a, Register b) {
    return a <= b;
  }
  DISMANTLE_HOST_DEVICE static Mask equal(Register a, Register b) {
    return a == b;
  }
  DISMANTLE_HOST_DEVICE static Register select(Mask m, Register a, Register b) {
    return m ? a : b;
  }
  DISMANTLE_HOST_DEVICE static Mask both(Mask a, Mask b) {
    return a && b;
  }
  DISMANTLE_HOST_DEVICE static Mask either(Mask a, Mask b) {
    return a || b;
  }
  DISMANTLE_HOST_DEVICE static Mask inverse(Mask a) {
    return !a;
  }
  DISMANTLE_HOST_DEVICE static unsigned bits(Mask m) {
    return m ? 1u : 0u;
  }
  ///@}
};

#if defined(__x86_64__)

/// Four floats with SSE2, which every x86-64 has.
template <>
struct LaneOperations<4> {
  using Register = __m128;
  using Mask = __m128;

  static Register load(const float* from) { return _mm_loadu_ps(from); }
  static void store(float* to, Register r) { _mm_storeu_ps(to, r); }
  static Register broadcast(float x) { return _mm_set1_ps(x); }
  static Register min(Register a, Register b) { return _mm_min_ps(a, b); }
  static Register max(Register a, Register b) { return _mm_max_ps(a, b); }
  static Register abs(Register a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
  static Register sqrt(Register a) { return _mm_sqrt_ps(a); }
  static Mask less(Register a, Register b) { return _mm_cmplt_ps(a, b); }
  static Mask less_or_equal(Register a, Register b) { return _mm_cmple_ps(a, b); }
  static Mask equal(Register a, Register b) { return _mm_cmpeq_ps(a, b); }
  static Register select(Mask m, Register a, Register b) { return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)); }
  static Mask both(Mask a, Mask b) { return _mm_and_ps(a, b); }
  static Mask either(Mask a, Mask b) { return _mm_or_ps(a, b); }
  static Mask inverse(Mask a) { return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1))); }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm_movemask_ps(m)); }
};

#else

/// Four floats on other machines.
template <>
struct LaneOperations<4> : PortableLaneOperations {};

#endif

#if defined(__AVX2__)

/// Eight floats with AVX2.
template <>
struct LaneOperations<8> {
  using Register = __m256;
  using Mask = __m256;

  static Register load(const float* from) { return _mm256_loadu_ps(from); }
  static void store(float* to, Register r) { _mm256_storeu_ps(to, r); }
  static Register broadcast(float x) { return _mm256_set1_ps(x); }
  static Register min(Register a, Register b) { return _mm256_min_ps(a, b); }
  static Register max(Register a, Register b) { return _mm256_max_ps(a, b); }
  static Register abs(Register a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  static Register sqrt(Register a) { return _mm256_sqrt_ps(a); }
  static Mask less(Register a, Register b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static Mask less_or_equal(Register a, Register b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static Mask equal(Register a, Register b) { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }
  static Register select(Mask m, Register a, Register b) { return _mm256_blendv_ps(b, a, m); }
  static Mask both(Mask a, Mask b) { return _mm256_and_ps(a, b); }
  static Mask either(Mask a, Mask b) { return _mm256_or_ps(a, b); }
  static Mask inverse(Mask a) { return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1))); }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
};

#endif

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)

/// Sixteen floats with AVX-512.
template <>
struct LaneOperations<16> {
  using Register = __m512;
  using Mask = __mmask16;
  /// All lanes: the unmasked intrinsics of GCC 12 read an uninitialized register, with a warning.
  static constexpr Mask kAll = 0xffff;

  static Register load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(float* to, Register r) { _mm512_storeu_ps(to, r); }
  static Register broadcast(float x) { return _mm512_set1_ps(x); }
  static Register min(Register a, Register b) { return _mm512_maskz_min_ps(kAll, a, b); }
  static Register max(Register a, Register b) { return _mm512_maskz_max_ps(kAll, a, b); }
  static Register abs(Register a) { return _mm512_abs_ps(a); }
  static Register sqrt(Register a) { return _mm512_maskz_sqrt_ps(kAll, a); }
  static Mask less(Register a, Register b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static Mask less_or_equal(Register a, Register b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static Mask equal(Register a, Register b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
  static Register select(Mask m, Register a, Register b) { return _mm512_mask_blend_ps(m, b, a); }
  static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  static Mask either(Mask a, Mask b) { return static_cast<Mask>(a | b); }
  static Mask inverse(Mask a) { return static_cast<Mask>(~a); }
  static unsigned bits(Mask m) { return m; }
};

#endif

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
