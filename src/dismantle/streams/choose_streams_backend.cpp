// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/choose_streams_backend.h"

#include "dismantle/streams/fallback_streams_backend.h"

#include <algorithm>

namespace dismantle {

ChosenStreamsBackend choose_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                            DeviceChoice choice) {
  ChosenStreamsBackend chosen;
  if (choice == DeviceChoice::Cuda ||
      (choice == DeviceChoice::Auto && triangle_count(assembly) >= kCudaWorthTriangles)) {
    const Result<std::string> name = cuda_device_name();
    CollisionOptions on_device = options;  // to grow an array is to repeat a step
    on_device.initial_capacity = std::max(options.initial_capacity, 2 * triangle_count(assembly));
    Result<std::unique_ptr<StreamsBackend>> backend = make_cuda_streams_backend(assembly, on_device);
    if (name && backend) {
      auto failure = std::make_shared<DeviceFailure>();
      const auto make_other = [&assembly, options] { return make_host_streams_backend(assembly, options); };
      return {std::make_unique<FallbackStreamsBackend>(std::move(*backend), make_other, failure), *name, "", failure};
    }
    if (choice == DeviceChoice::Cuda) chosen.why = backend.error().message;
  }
  chosen.backend = make_host_streams_backend(assembly, options);
  chosen.device = "cpu";
  return chosen;
}

}  // namespace dismantle
