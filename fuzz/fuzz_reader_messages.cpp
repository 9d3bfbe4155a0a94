// SPDX-License-Identifier: Apache-2.0
// The messages between dismantle and its reader programs. The first byte selects the kind of message.
#include "dismantle/isolation/isolated_line.h"
#include "dismantle/isolation/isolated_request.h"
#include "dismantle/loading/reader_messages.h"
#include "fuzz/fuzz_input.h"

#include <algorithm>

namespace {

using namespace dismantle;

/// The same messages in pieces of other sizes.
void take_line(const std::byte* data, std::size_t size) {
  IsolatedLineReader whole, pieces;
  const bool is_valid = whole.take(data, size);
  bool still_valid = true;
  for (std::size_t at = 0; at < size && still_valid; at += 7)
    still_valid = pieces.take(data + at, std::min<std::size_t>(7, size - at));
  fuzz::require(is_valid == still_valid, "the same verdict however the bytes arrive");
  if (is_valid) fuzz::require(whole.bytes() == pieces.bytes() && whole.stage() == pieces.stage(), "the same messages");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest = fuzz::text_of(data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      if (const auto request = request_from(rest)) fuzz::require(bytes_of(*request) == rest, "a request as it was");
      break;
    case 1:
      if (const auto request = reader_request_from(rest))
        fuzz::require(reader_request_from(bytes_of(*request)).has_value(), "a reader's request as it was");
      break;
    case 2:
      linked_files_in(rest);
      if (const auto assembly = assembly_in(rest))
        for (const Component& component : assembly->components) fuzz::require_sound(*component.mesh);
      break;
    default:
      take_line(reinterpret_cast<const std::byte*>(data + 1), size - 1);
  }
  return 0;
}
