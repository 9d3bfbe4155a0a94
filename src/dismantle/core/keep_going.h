// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace dismantle {

/// Returns false to end a search early. Called regularly, from any thread.
using KeepGoing = std::function<bool()>;

}  // namespace dismantle
