// SPDX-License-Identifier: Apache-2.0
#include "apps/server/journal_store.h"

#include "dismantle/files/read_file.h"

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

/// The contents of the journal, if it is of the session's assembly and not empty.
std::optional<JournalContents> read_journal(const fs::path& file, const JournalHeader& header) {
  const Result<std::string> bytes = read_file(file, kMaxJournalBytes);
  if (!bytes) return {};
  std::optional<JournalContents> contents = parse_journal(*bytes);
  if (!contents || !(contents->header == header) || contents->entries.empty()) return {};
  return contents;
}

}  // namespace

Result<bool> JournalStore::attach(Session& session) {
  file_.clear();
  if (!folder_) return false;
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
    if (contents && !crashed) fs::rename(file_, *folder_ / (stem_of(header) + ".previous"), error);
    journal = crashed ? Journal::go_on(file_, *contents) : Journal::create(file_, header);
    if (!crashed) contents.reset();
  }
  if (!journal) return journal.error();
  if (contents) session.restore(std::move(*contents));
  session.set_journal(std::move(*journal));
  return contents.has_value();
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
  return read_journal(*folder_ / (stem_of(header) + ".previous"), header);
}

bool JournalStore::can_resume(const Session& session) const {
  return previous(session).has_value();
}

Result<Done> JournalStore::resume(Session& session) const {
  std::optional<JournalContents> contents = previous(session);
  if (!contents)
    return Error{ErrorKind::Usage,
                 "there is no session to resume (none of this assembly was stored); continue with this one"};
  if (!session.done().empty() || !session.undone().empty() || session.activity() != SessionActivity::Idle)
    return Error{ErrorKind::Usage, "the last session cannot be resumed (this one has moves already); reset it first"};
  session.restore(std::move(*contents));
  return Done{};
}

}  // namespace dismantle::server
