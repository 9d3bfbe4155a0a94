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

/// Identifies the session of a journal; a session resumes from a journal only if all of this is equal.
struct JournalHeader {
  std::string assembly_name;          ///< File name.
  std::string assembly_sha256;        ///< Of the file.
  std::uint32_t component_count = 0;  ///< Of the assembly.
  double tolerance = 0;               ///< [mm]
  friend bool operator==(const JournalHeader&, const JournalHeader&) = default;
};

/// The contents of a journal.
struct JournalContents {
  JournalHeader header;               ///< The session.
  std::vector<SessionEntry> entries;  ///< Everything recorded, undone entries included.
  std::size_t done_count = 0;         ///< Number of entries in effect; those after them were undone.
  bool is_open = false;               ///< The last entry was still in progress.
  bool is_closed = false;             ///< The session ended normally.
  std::size_t whole_bytes = 0;        ///< Length of the valid records [bytes].
  /// Why the record after these is none, such as "a rotation is not of unit length"; empty if there is none, or its end
  /// is missing.
  std::string invalid;
};

/// Parses a journal up to the first record that is incomplete (its tail may be torn anywhere) or no valid state: in the
/// entries, poses are finite with rotations of unit length, times ascend, components are known, and each entry starts
/// where its components are. None if the header is incomplete.
std::optional<JournalContents> parse_journal(std::string_view bytes);

/// A write-ahead log of a session, so that it can be resumed after a crash: append-only, each record with a hash. Data
/// has left the process when a call returns (a killed process loses nothing) and is on the disk within a second (so
/// much may be lost with the power). Files are readable by their owner only.
class Journal {
 public:
  /// Starts a journal, replacing the file. Errors: Failed, also if another process writes it.
  static Result<std::unique_ptr<Journal>> create(const std::filesystem::path& file, const JournalHeader& header);
  /// Appends to a journal after its complete records. Errors: as create().
  static Result<std::unique_ptr<Journal>> go_on(const std::filesystem::path& file, const JournalContents& contents);
  /// Flushes everything to the disk.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Records the start of an entry.
  void begin(const SessionEntry& entry);
  /// Records frames of the present entry. @pre not empty
  void add_frames(Span<const Frame> frames);
  /// Records the end of an entry.
  void end(const SessionEntry& entry);
  void drop();   ///< Discards the entry in progress.
  void undo();   ///< Records an undo.
  void redo();   ///< Records a redo.
  void reset();  ///< Records that everything was reset.
  /// Records that the session consists of these entries now, the first `done_count` of them in effect. A process that
  /// is killed meanwhile leaves the session of before.
  void replace(Span<const SessionEntry> entries, std::size_t done_count);
  void close();  ///< Records that the session ended normally.

  /// True if a record could not be written (disk full); the journal is incomplete from then on.
  bool has_failed() const;

 private:
  class Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
