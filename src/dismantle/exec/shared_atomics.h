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

/// As atomic_add(counter, each). On CUDA, the threads of a warp that arrive together make one addition ("warp
/// aggregation"). @pre all of these have the same counter and the same `each`
DISMANTLE_HOST_DEVICE inline std::uint64_t atomic_count(std::uint64_t* counter, std::uint32_t each = 1) {
#if defined(__CUDA_ARCH__)
  const unsigned group = __activemask(), lane = threadIdx.x % 32;
  const int first = __ffs(static_cast<int>(group)) - 1;
  unsigned long long before = 0;
  if (static_cast<int>(lane) == first)
    before = atomicAdd(reinterpret_cast<unsigned long long*>(counter),
                       each * static_cast<unsigned long long>(__popc(group)));
  return __shfl_sync(group, before, first) + each * static_cast<unsigned>(__popc(group & ((1u << lane) - 1)));
#else
  return atomic_add(counter, each);
#endif
}

/// Adds to a counter whose old value is not needed. On CUDA, the threads of a warp that arrive together make one
/// addition. @pre all of these have the same counter; their sum is below 2^32
DISMANTLE_HOST_DEVICE inline void atomic_sum(std::uint64_t* counter, std::uint32_t value) {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
  const unsigned group = __activemask(), lane = threadIdx.x % 32;
  const unsigned sum = __reduce_add_sync(group, value);
  if (static_cast<int>(lane) == __ffs(static_cast<int>(group)) - 1) atomic_add(counter, sum);
#else
  atomic_add(counter, value);
#endif
}

/// Sets a word to the smaller of itself and `value`, without ordering other memory accesses.
DISMANTLE_HOST_DEVICE inline void atomic_lower(std::uint64_t* word, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  // A word only gets smaller: what is no smaller than an old value of it need not be written.
  if (value >= *reinterpret_cast<volatile std::uint64_t*>(word)) return;
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
