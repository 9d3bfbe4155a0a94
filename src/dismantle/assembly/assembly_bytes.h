// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/byte_stream.h"
#include "dismantle/core/result.h"

#include <cstddef>
#include <optional>

namespace dismantle {

/// Serialises an assembly exactly, each shared mesh once, in native byte order: for another process of the same
/// program, not for files.
void write_assembly_bytes(const Assembly& assembly, const ByteSink& sink);

/// The assembly that write_assembly_bytes wrote, meshes shared as they were; none if the bytes are malformed (every
/// count and index is checked).
std::optional<Assembly> assembly_from_bytes(Span<const std::byte> bytes);

}  // namespace dismantle
