// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/stop_signal.h"

#include <csignal>

namespace dismantle::batch {

namespace {

volatile std::sig_atomic_t g_stop = 0;

void stop(int) {
  g_stop = 1;
}

}  // namespace

void watch_stop_signal() {
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
}

bool stop_requested() {
  return g_stop != 0;
}

}  // namespace dismantle::batch
