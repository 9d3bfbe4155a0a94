// SPDX-License-Identifier: Apache-2.0
#include "dismantle/candidates/motion_batch.h"

#include "dismantle/candidates/device_batch.h"
#include "dismantle/candidates/fallback_motion_batch.h"
#include "dismantle/exec/host_queue.h"

namespace dismantle {

ChosenMotionBatch make_motion_batch(const Assembly& assembly, const PairStates& pairs, const Executor& executor,
                                    DeviceChoice choice) {
  ChosenMotionBatch chosen;
  const auto make_on_cpu = [&assembly, pairs, executor]() -> std::unique_ptr<MotionBatch> {
    return std::make_unique<DeviceBatch<HostQueue>>(HostQueue(executor), assembly, pairs, executor);
  };
  if (choice != DeviceChoice::Cpu) {
    const Result<std::string> name = cuda_device_name();
    Result<std::unique_ptr<MotionBatch>> batch = make_cuda_motion_batch(assembly, pairs, executor);
    if (name && batch) {
      auto failure = std::make_shared<DeviceFailure>();
      return {std::make_unique<FallbackMotionBatch>(std::move(*batch), make_on_cpu, failure), *name, "", failure};
    }
    if (choice == DeviceChoice::Cuda) chosen.why = batch.error().message;
  }
  chosen.batch = make_on_cpu();
  chosen.device = "cpu";
  return chosen;
}

}  // namespace dismantle
