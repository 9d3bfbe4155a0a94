// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace dismantle {

/// Whether to go on searching: asked now and then, by any thread.
using KeepGoing = std::function<bool()>;

}  // namespace dismantle
