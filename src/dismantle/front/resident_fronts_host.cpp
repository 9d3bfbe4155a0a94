// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/host_queue.h"
#include "dismantle/front/resident_fronts.h"

namespace dismantle {

std::unique_ptr<FrontDevice> make_played_front_device(const Executor& device, std::size_t capacity) {
  return std::make_unique<ResidentFronts<HostQueue>>(HostQueue(device), capacity);
}

}  // namespace dismantle
