// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/host_device.h"

#include <cassert>
#include <cstdio>
#include <cstdlib>

/// Contracts report our own bugs: a caller that broke a precondition, a function that broke its promise. Errors in the
/// user's input are a Result. Contracts are checked if DISMANTLE_CONTRACTS is defined (dev and sanitizer builds), on
/// the host and on the device; a broken one ends the program.
#if defined(DISMANTLE_CONTRACTS)
#if defined(__CUDA_ARCH__)
#define DISMANTLE_CONTRACT_FAILED(kind, text) assert(false)
#else
#define DISMANTLE_CONTRACT_FAILED(kind, text) ::dismantle::contract_failed(kind, text, __FILE__, __LINE__)
#endif
/// Checks a precondition on entry: the caller's promise.
#define DISMANTLE_EXPECT(condition) ((condition) ? (void)0 : DISMANTLE_CONTRACT_FAILED("expected", #condition))
/// Checks a postcondition on exit: the function's promise.
#define DISMANTLE_ENSURE(condition) ((condition) ? (void)0 : DISMANTLE_CONTRACT_FAILED("ensured", #condition))
#else
#define DISMANTLE_EXPECT(condition) ((void)0)
#define DISMANTLE_ENSURE(condition) ((void)0)
#endif

namespace dismantle {

/// Prints the broken contract with its file and line and aborts.
[[noreturn]] inline void contract_failed(const char* kind, const char* text, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: contract broken: %s %s\n", file, line, kind, text);
  std::abort();
}

}  // namespace dismantle
