// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <atomic>
#include <cstdint>

/// Atomic operations on plain words that kernel bodies share: the same text for CPU threads and CUDA.
namespace dismantle {

/// Adds to a counter; what else memory holds is not ordered by it. @return the counter before
DISMANTLE_HOST_DEVICE inline std::uint64_t atomic_add(std::uint64_t* counter, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(reinterpret_cast<unsigned long long*>(counter), static_cast<unsigned long long>(value));
#else
  return std::atomic_ref<std::uint64_t>(*counter).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Lowers a word to `value` where that is less.
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

/// Counts who comes to a place. Whoever comes later sees all that those before had written when they came.
/// @return how many were there before
DISMANTLE_HOST_DEVICE inline std::uint32_t arrive(std::uint32_t* place) {
#if defined(__CUDA_ARCH__)
  __threadfence();
  const std::uint32_t before = atomicAdd(place, 1u);
  __threadfence();
  return before;
#else
  return std::atomic_ref<std::uint32_t>(*place).fetch_add(1, std::memory_order_acq_rel);
#endif
}

}  // namespace dismantle
