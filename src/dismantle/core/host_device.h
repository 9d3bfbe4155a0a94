// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks a function that both the CPU and CUDA compile: the same text, the same bits.
#if defined(__CUDACC__)
#define DISMANTLE_HOST_DEVICE __host__ __device__
#else
#define DISMANTLE_HOST_DEVICE
#endif
