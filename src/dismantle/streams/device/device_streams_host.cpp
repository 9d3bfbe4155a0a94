// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/host_queue.h"
#include "dismantle/streams/device/device_streams_backend.h"

namespace dismantle {

std::unique_ptr<StreamsBackend> make_emulated_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                                              const Executor& device) {
  return std::make_unique<DeviceStreamsBackend<HostQueue>>(HostQueue(device), assembly, options);
}

}  // namespace dismantle
