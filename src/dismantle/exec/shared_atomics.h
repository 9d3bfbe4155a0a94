// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <atomic>
#include <cstdint>

/// Atomic operations on plain words for kernels, on CPU threads and CUDA.
namespace dismantle {

/// Adds to a counter without ordering other memory accesses. @return the value before
DISMANTLE_HOST_DEVICE inline std::uint64_t atomic_add(std::uint64_t* counter, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(reinterpret_cast<unsigned long long*>(counter), static_cast<unsigned long long>(value));
#else
  return std::atomic_ref<std::uint64_t>(*counter).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Sets a word to the smaller of itself and `value`, without ordering other memory accesses.
DISMANTLE_HOST_DEVICE inline void atomic_lower(std::uint64_t* word, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  atomicMin(reinterpret_cast<unsigned long long*>(word), static_cast<unsigned long long>(value));
#else
  const std::atomic_ref<std::uint64_t> shared(*word);
  std::uint64_t seen = shared.load(std::memory_order_relaxed);
  while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
#endif
}

/// Adds 1 to a counter of arrivals. A thread sees everything that those before it had written when they arrived.
/// @return the number of arrivals before
DISMANTLE_HOST_DEVICE inline std::uint32_t arrive(std::uint32_t* counter) {
#if defined(__CUDA_ARCH__)
  __threadfence();
  const std::uint32_t before = atomicAdd(counter, 1u);
  __threadfence();
  return before;
#else
  return std::atomic_ref<std::uint32_t>(*counter).fetch_add(1, std::memory_order_acq_rel);
#endif
}

}  // namespace dismantle
