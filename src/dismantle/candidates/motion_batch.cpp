// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/motion_batch.h"

#include "dismantle/candidates/device_batch.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/exec/host_queue.h"

namespace dismantle {

ChosenMotionBatch make_motion_batch(const Assembly& assembly, const PairStates& pairs, const Executor& executor,
                                    DeviceChoice choice) {
  ChosenMotionBatch chosen;
  if (choice != DeviceChoice::Cpu) {
    const Result<std::string> name = cuda_device_name();
    Result<std::unique_ptr<MotionBatch>> batch = make_cuda_motion_batch(assembly, pairs, executor);
    if (name && batch) return {std::move(*batch), *name, ""};
    if (choice == DeviceChoice::Cuda) chosen.why = batch.error().message;
  }
  chosen.batch = std::make_unique<DeviceBatch<HostQueue>>(HostQueue(executor), assembly, pairs, executor);
  chosen.device = "cpu";
  return chosen;
}

}  // namespace dismantle
