// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/core/span.h"
#include "dismantle/session/session_entry.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// What a journal is of; a session goes on with one only where this is the same.
struct JournalHeader {
  std::string assembly_name;
  std::string assembly_sha256;
  std::uint32_t component_count = 0;
  double tolerance = 0;  ///< [mm]
  friend bool operator==(const JournalHeader&, const JournalHeader&) = default;
};

/// What a journal says was done.
struct JournalContents {
  JournalHeader header;
  std::vector<SessionEntry> entries;
  std::size_t done_count = 0;   ///< Of the entries; those behind were undone.
  bool is_open = false;         ///< The last entry was still going on.
  bool is_closed = false;       ///< The session ended in order.
  std::size_t whole_bytes = 0;  ///< Up to where the bytes are whole records.
};

/// Reads a journal from its bytes, up to the first record that is not whole: its tail may be torn anywhere. None where
/// not even the header is whole.
std::optional<JournalContents> parse_journal(std::string_view bytes);

/// Writes down a session while it happens, so that it can go on after a crash: append-only, each record checked by a
/// hash. What is written has left the process when a call returns (a killed process loses nothing), and is on the
/// disk within a second (a power loss loses no more than that). Files are readable by their owner only.
class Journal {
 public:
  /// Begins a journal, replacing what bore the name. Errors: Failed, also where another process writes it.
  static Result<std::unique_ptr<Journal>> create(const std::filesystem::path& file, const JournalHeader& header);
  /// Goes on with one behind its whole records. Errors: as create().
  static Result<std::unique_ptr<Journal>> go_on(const std::filesystem::path& file, const JournalContents& contents);
  /// Everything written is on the disk then.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void begin(const SessionEntry& entry);
  /// @pre not empty
  void add_frames(Span<const Frame> frames);
  void end(const SessionEntry& entry);
  void drop();  ///< The entry that was begun is none.
  void undo();
  void redo();
  void reset();
  void close();

  /// Whether something could not be written (disk full); the journal is of no use from then on.
  bool has_failed() const;

 private:
  class Body;
  explicit Journal(std::unique_ptr<Body> body);
  std::unique_ptr<Body> body_;
};

}  // namespace dismantle
