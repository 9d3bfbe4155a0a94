// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/device/device_fronts.h"
#include "dismantle/exec/host_queue.h"

namespace dismantle {

std::unique_ptr<FrontDevice> make_emulated_front_device(const Executor& device, std::size_t capacity) {
  return std::make_unique<DeviceFronts<HostQueue>>(HostQueue(device), capacity);
}

}  // namespace dismantle
