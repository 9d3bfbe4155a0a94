// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle::batch {

/// Installs handlers with which SIGINT and SIGTERM do not end this process and its forked children, but set a flag.
void watch_stop_signal();
/// True if one of these signals was received.
bool stop_requested();

}  // namespace dismantle::batch
