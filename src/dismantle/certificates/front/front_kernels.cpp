// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_kernels.h"

namespace dismantle {

FrontKernels front_kernels(LaneCount lanes) {
  return with_lanes(lanes, [](auto count) {
    return FrontKernels{&check_certificates_kernel<count>, &separate_boxes_kernel<count>,
                        &separate_triangles_kernel<count>};
  });
}

}  // namespace dismantle
