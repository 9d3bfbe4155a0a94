// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle::batch {

/// From now on SIGINT and SIGTERM no longer end this process and the children that it forks, but are remembered.
void watch_stop_signal();
/// True once one of them was received.
bool stop_requested();

}  // namespace dismantle::batch
