// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks a function that is compiled for the CPU and for CUDA, with bit-identical results.
#if defined(__CUDACC__)
#define DISMANTLE_HOST_DEVICE __host__ __device__
#else
#define DISMANTLE_HOST_DEVICE
#endif
