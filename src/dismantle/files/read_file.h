// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace dismantle {

/// The bytes of a regular file. Errors: Unreadable if it is missing, empty, a folder, not a regular file (a device, a
/// pipe), not permitted, or larger than `limit_bytes`; its size is checked before memory is allocated.
Result<std::string> read_file(const std::filesystem::path& file, std::size_t limit_bytes);

}  // namespace dismantle
