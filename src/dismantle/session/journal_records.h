// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/journal.h"

#include <string>
#include <string_view>

namespace dismantle {

/// Kinds of journal records. A record is the length (u32) and hash (u32) of its payload, then the payload, whose first
/// byte is the kind; little-endian.
enum class JournalRecord : char {
  Header = 'H',
  Begin = 'B',
  Frames = 'F',
  End = 'E',
  Drop = 'X',
  Undo = 'U',
  Redo = 'R',
  Reset = 'Z',
  Replace = 'W',  // its payload is records that replace all before them
  Close = 'C',
};

/// The record that identifies the session.
std::string header_record(const JournalHeader& header);
/// The record of the start of an entry.
std::string begin_record(const SessionEntry& entry);
/// The record of frames of the present entry.
std::string frames_record(Span<const Frame> frames);
/// The record of the end of an entry.
std::string end_record(const SessionEntry& entry);
/// The record of a whole session, which is valid as a whole or not at all.
std::string replace_record(Span<const SessionEntry> entries, std::size_t done_count);
/// A record without further payload.
std::string plain_record(JournalRecord kind);

}  // namespace dismantle
