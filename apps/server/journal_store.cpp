// SPDX-License-Identifier: Apache-2.0
#include "apps/server/journal_store.h"

#include "dismantle/files/read_file.h"

#include <cstdio>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxJournalBytes = std::size_t{2} << 30;
/// Maximum number of viewers of one assembly that run at the same time.
constexpr int kMaxViewers = 8;
constexpr std::size_t kHashDigits = 24;

std::string stem_of(const JournalHeader& header) {
  return header.assembly_sha256.substr(0, kHashDigits) + '-' + std::to_string(header.component_count);
}

/// Name of the journal of the first viewer of an assembly, or of a further one that runs at the same time.
std::string file_name(const JournalHeader& header, int viewer) {
  std::string name = stem_of(header);
  if (viewer > 1) name.append(1, '-').append(std::to_string(viewer));
  return name + ".journal";
}

/// The contents of the journal, if it is of the session's assembly and not empty, be it invalid.
std::optional<JournalContents> read_journal(const fs::path& file, const JournalHeader& header) {
  const Result<std::string> bytes = read_file(file, kMaxJournalBytes);
  if (!bytes) return {};
  std::optional<JournalContents> contents = parse_journal(*bytes);
  if (!contents || !(contents->header == header)) return {};
  if (contents->entries.empty() && contents->invalid.empty()) return {};
  return contents;
}

/// "3 moves"
std::string moves_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " move" : " moves");
}

/// Restores the last valid state, and says what is not restored.
RestoredSession restore(Session& session, const JournalContents& contents) {
  const RestorableState state = session.restore(contents);
  RestoredSession restored{!session.done().empty() || !session.undone().empty(), {}};
  std::string why;
  if (state.too_deep) {
    char depth[32];
    std::snprintf(depth, sizeof depth, "%.3g", state.too_deep->depth);
    const Assembly& all = session.assembly();
    why = "after it, '" + all[state.too_deep->a].name + "' is " + depth + " mm deep in '" +
          all[state.too_deep->b].name + "', which is more than is allowed";
  } else if (!contents.invalid.empty()) {
    why = "the next record of its journal is invalid: " + contents.invalid;
  }
  if (!why.empty())
    restored.warning = "the last session is restored only up to its last valid state, with " +
                       moves_text(session.done().size()) + " (" + why + "); check the moves and go on from there";
  return restored;
}

}  // namespace

Result<RestoredSession> JournalStore::attach(Session& session) {
  file_.clear();
  if (!folder_) return RestoredSession{};
  std::error_code error;
  fs::create_directories(*folder_, error);
  fs::permissions(*folder_, fs::perms::owner_all, error);
  const JournalHeader header = session.journal_header();
  Result<std::unique_ptr<Journal>> journal = Error{};
  std::optional<JournalContents> contents;
  for (int viewer = 1; viewer <= kMaxViewers && !journal; ++viewer) {
    file_ = *folder_ / file_name(header, viewer);
    contents = read_journal(file_, header);
    const bool crashed = contents && !contents->is_closed;
    if (crashed && !contents->invalid.empty())
      fs::copy_file(file_, *folder_ / (stem_of(header) + ".invalid"), fs::copy_options::overwrite_existing, error);
    if (contents && !crashed) fs::rename(file_, *folder_ / (stem_of(header) + ".previous"), error);
    journal = crashed ? Journal::go_on(file_, *contents) : Journal::create(file_, header);
    if (!crashed) contents.reset();
  }
  if (!journal) return journal.error();
  session.set_journal(std::move(*journal));
  if (!contents) return RestoredSession{};
  RestoredSession restored = restore(session, *contents);
  if (!restored.warning.empty()) session.rewrite_journal();
  return restored;
}

void JournalStore::detach(Session& session) {
  if (file_.empty() || session.journal() == nullptr) return;
  session.stop_playback();
  session.release();
  const bool is_empty = session.done().empty() && session.undone().empty();
  session.close_journal();
  std::error_code ignored;
  if (is_empty) fs::remove(file_, ignored);
}

std::optional<JournalContents> JournalStore::previous(const Session& session) const {
  if (!folder_) return {};
  const JournalHeader header = session.journal_header();
  std::optional<JournalContents> contents = read_journal(*folder_ / (stem_of(header) + ".previous"), header);
  if (contents && contents->entries.empty()) return {};
  return contents;
}

bool JournalStore::can_resume(const Session& session) const {
  return previous(session).has_value();
}

Result<RestoredSession> JournalStore::resume(Session& session) const {
  std::optional<JournalContents> contents = previous(session);
  if (!contents)
    return Error{ErrorKind::Usage,
                 "there is no session to resume (none of this assembly was stored); continue with this one"};
  if (!session.done().empty() || !session.undone().empty() || session.activity() != SessionActivity::Idle)
    return Error{ErrorKind::Usage, "the last session cannot be resumed (this one has moves already); reset it first"};
  const RestoredSession restored = restore(session, *contents);
  session.rewrite_journal();
  return restored;
}

}  // namespace dismantle::server
