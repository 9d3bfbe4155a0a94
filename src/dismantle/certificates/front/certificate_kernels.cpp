// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/box_lanes.h"

namespace dismantle {

template <>
CertificateCheck check_certificates_kernel<DISMANTLE_LANE_COUNT>(const CertificateBlocks& certificates,
                                                                 std::size_t count, const LinearSweep& sweep,
                                                                 std::uint32_t* failing) {
  constexpr int kLanes = DISMANTLE_LANE_COUNT;
  using F = Lanes<kLanes>;
  const F huge(3e38f);
  std::size_t found = 0;
  F smallest = huge;
  float number[kLanes];
  for (int l = 0; l < kLanes; ++l) number[l] = static_cast<float>(l);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const F gaps = min_gaps<kLanes>(certificates, i, sweep);
    const auto holds = gaps >= F(sweep.limit);
    const auto real = F::load(number) < F(static_cast<float>(count - i));  // not of the padding
    smallest = min(smallest, select(holds & real, gaps, huge));
    for (unsigned failed = bits((!holds) & real); failed != 0; failed &= failed - 1)
      failing[found++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(__builtin_ctz(failed));
  }
  float gap[kLanes];
  smallest.store(gap);
  CertificateCheck check;
  check.failing = found;
  for (int l = 0; l < kLanes; ++l) check.min_gap = gap[l] < check.min_gap ? gap[l] : check.min_gap;
  return check;
}

template <>
void separate_boxes_kernel<DISMANTLE_LANE_COUNT>(const BoxPairQuery* queries, std::size_t count,
                                                 const LinearSweep& sweep, NodeSeparation* separations) {
  separate_box_lanes<DISMANTLE_LANE_COUNT>(queries, count, sweep, separations);
}

}  // namespace dismantle
