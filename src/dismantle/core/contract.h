// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <cassert>
#include <cstdio>
#include <cstdlib>

/// Contracts tell *our* bugs (a caller broke a precondition, a function its promise); what the user's input gets wrong
/// is a Result. They are checked where DISMANTLE_CONTRACTS is set (dev and sanitizer builds), on the host and on the
/// device.
///   DISMANTLE_EXPECT(condition)  on entry: the caller's promise
///   DISMANTLE_ENSURE(condition)  on exit: our promise
#if defined(DISMANTLE_CONTRACTS)
#if defined(__CUDA_ARCH__)
#define DISMANTLE_CONTRACT_FAILED(kind, text) assert(false)
#else
#define DISMANTLE_CONTRACT_FAILED(kind, text) ::dismantle::contract_failed(kind, text, __FILE__, __LINE__)
#endif
#define DISMANTLE_EXPECT(condition) ((condition) ? (void)0 : DISMANTLE_CONTRACT_FAILED("expected", #condition))
#define DISMANTLE_ENSURE(condition) ((condition) ? (void)0 : DISMANTLE_CONTRACT_FAILED("ensured", #condition))
#else
#define DISMANTLE_EXPECT(condition) ((void)0)
#define DISMANTLE_ENSURE(condition) ((void)0)
#endif

namespace dismantle {

/// Prints the broken contract with its place and aborts.
[[noreturn]] inline void contract_failed(const char* kind, const char* text, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: contract broken: %s %s\n", file, line, kind, text);
  std::abort();
}

}  // namespace dismantle
