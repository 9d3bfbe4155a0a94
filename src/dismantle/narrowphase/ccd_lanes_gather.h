// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/lanes.h"
#include "dismantle/math/vec3.h"
#include "dismantle/narrowphase/ccd_lanes_kernel.h"

#include <cstddef>

/// Conversion of motions in double to lanes of float, for lane kernels only (math/lanes.h).
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// A vector in each lane.
template <int kLanes>
using LaneVec = Vec3T<Lanes<kLanes>>;

/// Three of the four points of a motion in each lane, relative to the fourth at the same end: differences in double,
/// rounded to float.
template <int kLanes>
struct RelativePoints {
  LaneVec<kLanes> at[2][3];  ///< Shape [end][point] [mm].
};

/// Motions that are adjacent in memory, one per lane.
struct ConsecutiveMotions {
  const double* first;  ///< The motion of lane 0.

  /// The motion of a lane.
  const double* operator[](int lane) const { return first + lane * kMotionDoubles; }
};

/// Motions given by their indices, one per lane.
struct ListedMotions {
  const double* motions;         ///< All motions.
  const std::uint32_t* indices;  ///< Of each lane.

  /// The motion of a lane.
  const double* operator[](int lane) const { return motions + std::size_t{indices[lane]} * kMotionDoubles; }
};

/// The point in rows kRow to kRow + 2 of every motion, relative to the one in kOrigin to kOrigin + 2.
template <int kLanes, int kRow, int kOrigin>
struct GatherPoint {
  static_assert(kLanes == 1);

  /// Gathers the point of each lane.
  template <class Motions>
  static LaneVec<1> from(Motions motions) {
    const double* m = motions[0];
    return {static_cast<float>(m[kRow] - m[kOrigin]), static_cast<float>(m[kRow + 1] - m[kOrigin + 1]),
            static_cast<float>(m[kRow + 2] - m[kOrigin + 2])};
  }
};

#if defined(__x86_64__)

/// 4 lanes.
template <int kRow, int kOrigin>
struct GatherPoint<4, kRow, kOrigin> {
  /// Gathers the point of each lane.
  template <class Motions>
  static LaneVec<4> from(Motions motions) {
    const __m128 xy01 = _mm_movelh_ps(xy(motions[0]), xy(motions[1])),
                 xy23 = _mm_movelh_ps(xy(motions[2]), xy(motions[3]));
    const __m128 z = _mm_movelh_ps(zz(motions[0], motions[1]), zz(motions[2], motions[3]));
    return {Lanes<4>(_mm_shuffle_ps(xy01, xy23, 0x88)), Lanes<4>(_mm_shuffle_ps(xy01, xy23, 0xdd)), Lanes<4>(z)};
  }

 private:
  static __m128 xy(const double* m) {
    return _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(m + kRow), _mm_loadu_pd(m + kOrigin)));
  }
  static __m128 zz(const double* m, const double* n) {
    return _mm_cvtpd_ps(_mm_sub_pd(_mm_set_pd(n[kRow + 2], m[kRow + 2]), _mm_set_pd(n[kOrigin + 2], m[kOrigin + 2])));
  }
};

#else

/// 4 lanes.
template <int kRow, int kOrigin>
struct GatherPoint<4, kRow, kOrigin> {
  /// Gathers the point of each lane.
  template <class Motions>
  static LaneVec<4> from(Motions motions) {
    float x[3][4];
    for (int c = 0; c < 3; ++c)
      for (int lane = 0; lane < 4; ++lane)
        x[c][lane] = static_cast<float>(motions[lane][kRow + c] - motions[lane][kOrigin + c]);
    return {Lanes<4>::load(x[0]), Lanes<4>::load(x[1]), Lanes<4>::load(x[2])};
  }
};

#endif

#if defined(__AVX2__)

/// 8 lanes.
template <int kRow, int kOrigin>
struct GatherPoint<8, kRow, kOrigin> {
  /// Gathers the point of each lane.
  template <class Motions>
  static LaneVec<8> from(Motions motions) {
    // Four rows of two motions in each register, then a 4x4 transposition in each half.
    const __m256 a = rows(motions[0], motions[4]), b = rows(motions[1], motions[5]);
    const __m256 c = rows(motions[2], motions[6]), d = rows(motions[3], motions[7]);
    const __m256d ab_low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)),
                  ab_high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
    const __m256d cd_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, d)),
                  cd_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    const Lanes<8> column[4] = {Lanes<8>(_mm256_castpd_ps(_mm256_unpacklo_pd(ab_low, cd_low))),
                                Lanes<8>(_mm256_castpd_ps(_mm256_unpackhi_pd(ab_low, cd_low))),
                                Lanes<8>(_mm256_castpd_ps(_mm256_unpacklo_pd(ab_high, cd_high))),
                                Lanes<8>(_mm256_castpd_ps(_mm256_unpackhi_pd(ab_high, cd_high)))};
    return {column[kBefore], column[kBefore + 1], column[kBefore + 2]};
  }

 private:
  /// Four rows are read. For the last point they begin one row earlier, so that they end with the motion.
  static constexpr int kBefore = kRow + 4 > kMotionDoubles ? 1 : 0;
  static_assert(kOrigin >= kBefore && kOrigin - kBefore + 4 <= kMotionDoubles);

  static __m128 rows(const double* m) {
    return _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd(m + kRow - kBefore), _mm256_loadu_pd(m + kOrigin - kBefore)));
  }
  static __m256 rows(const double* low, const double* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(rows(low)), rows(high), 1);
  }
};

#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)

/// 16 lanes.
template <int kRow, int kOrigin>
struct GatherPoint<16, kRow, kOrigin> {
  /// Gathers the point of each lane.
  template <class Motions>
  static LaneVec<16> from(Motions motions) {
    using Half = GatherPoint<8, kRow, kOrigin>;
    const LaneVec<8> low = Half::from(Shifted<Motions, 0>{motions}), high = Half::from(Shifted<Motions, 8>{motions});
    return {both(low.x, high.x), both(low.y, high.y), both(low.z, high.z)};
  }

 private:
  template <class Motions, int kFirst>
  struct Shifted {
    Motions motions;
    const double* operator[](int lane) const { return motions[kFirst + lane]; }
  };
  static Lanes<16> both(Lanes<8> low, Lanes<8> high) {
    return Lanes<16>(_mm512_insertf32x8(_mm512_castps256_ps512(low.r), high.r, 1));
  }
};

#endif

/// Layout of a VertexFaceMotion: vertex_t0, vertex_t1, face_t0[3], face_t1[3].
struct VertexFaceRows {
  /// The corners of the face relative to the vertex.
  template <int kLanes, class Motions>
  static RelativePoints<kLanes> gather(Motions m) {
    return {
        {{GatherPoint<kLanes, 6, 0>::from(m), GatherPoint<kLanes, 9, 0>::from(m), GatherPoint<kLanes, 12, 0>::from(m)},
         {GatherPoint<kLanes, 15, 3>::from(m), GatherPoint<kLanes, 18, 3>::from(m),
          GatherPoint<kLanes, 21, 3>::from(m)}}};
  }
};

/// Layout of an EdgeEdgeMotion: a_t0[2], a_t1[2], b_t0[2], b_t1[2].
struct EdgeEdgeRows {
  /// a[1], b[0] and b[1] relative to a[0].
  template <int kLanes, class Motions>
  static RelativePoints<kLanes> gather(Motions m) {
    return {
        {{GatherPoint<kLanes, 3, 0>::from(m), GatherPoint<kLanes, 12, 0>::from(m), GatherPoint<kLanes, 15, 0>::from(m)},
         {GatherPoint<kLanes, 9, 6>::from(m), GatherPoint<kLanes, 18, 6>::from(m),
          GatherPoint<kLanes, 21, 6>::from(m)}}};
  }
};

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
