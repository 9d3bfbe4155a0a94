// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/journal.h"

#include <string>
#include <string_view>

namespace dismantle {

/// The records of a journal: length (u32) and hash (u32) of the payload, the payload; its first byte is the kind.
/// Little-endian.
enum class JournalRecord : char {
  Header = 'H',
  Begin = 'B',
  Frames = 'F',
  End = 'E',
  Drop = 'X',
  Undo = 'U',
  Redo = 'R',
  Reset = 'Z',
  Close = 'C',
};

std::string header_record(const JournalHeader& header);
std::string begin_record(const SessionEntry& entry);
std::string frames_record(Span<const Frame> frames);
std::string end_record(const SessionEntry& entry);
/// Of the kinds that say no more than that.
std::string plain_record(JournalRecord kind);

}  // namespace dismantle
