// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/journal.h"

#include "dismantle/files/read_file.h"
#include "tests/session/session_table.h"
#include "tests/support/scratch_folder.h"

namespace dismantle {
namespace {

using scenes::kFirst;
using scenes::kSecond;
using scenes::pinned_plates;
using scenes::Table;
using scenes::wall_and_block;

JournalContents contents_of(const std::filesystem::path& file) {
  const Result<std::string> bytes = read_file(file, 1 << 24);
  EXPECT_TRUE(bytes.ok());
  std::optional<JournalContents> contents = parse_journal(*bytes);
  EXPECT_TRUE(contents);
  return *contents;
}

void begin_journal(Table& table, const std::filesystem::path& file) {
  Result<std::unique_ptr<Journal>> journal = Journal::create(file, table.session().journal_header());
  ASSERT_TRUE(journal.ok());
  table.session().set_journal(std::move(*journal));
}

/// Performs some of everything that is recorded.
void work(Table& table) {
  Session& session = table.session();
  ASSERT_TRUE(session.take_out(kFirst, Vec3{0, 0, 1}).ok());
  table.let_run();
  table.move(kSecond, {0, 0.3, 15}, 15);
  table.move(kSecond, {1, 0, 5}, 4);
  ASSERT_TRUE(session.undo().ok());
  ASSERT_TRUE(session.hold(kSecond).ok());
  session.release();  // nothing moved
  table.drag(kSecond, {-1, 0, 0}, 3);
  session.cancel_drag();
  ASSERT_TRUE(session.redo().ok());
  ASSERT_TRUE(session.undo().ok());
  ASSERT_TRUE(session.put_back(kFirst).ok());
  for (int i = 0; i < 20; ++i) session.advance(0.02);
  session.halt();
  table.drag(kSecond, {0, 0, -2}, 5);
}

TEST(Journal, HasEverythingThatWasDone) {
  const ScratchFolder folder;
  Table table(pinned_plates());
  begin_journal(table, folder / "journal");
  work(table);
  table.session().release();
  const JournalContents contents = contents_of(folder / "journal");
  EXPECT_EQ(contents.header, table.session().journal_header());
  ASSERT_EQ(contents.done_count, table.session().done().size());
  for (std::size_t i = 0; i < contents.done_count; ++i) EXPECT_EQ(contents.entries[i], table.session().done()[i]) << i;
  EXPECT_FALSE(contents.is_closed || contents.is_open);
}

TEST(Journal, RestoresASessionToTheSameBits) {
  const ScratchFolder folder;
  Table table(pinned_plates()), other(pinned_plates());
  begin_journal(table, folder / "journal");
  work(table);  // and its process ends during a drag
  JournalContents contents = contents_of(folder / "journal");
  EXPECT_TRUE(contents.is_open);
  other.session().restore(contents);
  EXPECT_EQ(other.poses(), table.poses());
  for (std::uint32_t c = 0; c < 3; ++c)
    EXPECT_EQ(other.session().is_removed(ComponentId(c)), table.session().is_removed(ComponentId(c)));
  EXPECT_EQ(other.session().recording(), table.session().recording());
  table.session().release();
  while (table.session().undo().ok()) {
    ASSERT_TRUE(other.session().undo().ok());
    EXPECT_EQ(other.poses(), table.poses());
  }
  EXPECT_FALSE(other.session().undo().ok());
}

TEST(Journal, IsGoodUpToItsLastWholeRecordWhereverItsTailIsCut) {
  const ScratchFolder folder;
  Table table(pinned_plates());
  begin_journal(table, folder / "journal");
  work(table);
  const std::string whole = *read_file(folder / "journal", 1 << 24);
  std::size_t last_bytes = 0, states = 0;
  for (std::size_t n = 0; n <= whole.size(); ++n) {
    const std::optional<JournalContents> contents = parse_journal(std::string_view(whole).substr(0, n));
    if (!contents) continue;
    ASSERT_LE(contents->whole_bytes, n);
    ASSERT_GE(contents->whole_bytes, last_bytes);
    ASSERT_LE(contents->done_count, contents->entries.size());
    for (const SessionEntry& entry : contents->entries) {
      ASSERT_FALSE(entry.frames.empty());
      ASSERT_EQ(entry.removed_before.size(), entry.components.size());
    }
    if (contents->whole_bytes == last_bytes) continue;
    last_bytes = contents->whole_bytes;
    if (states++ % 8 != 0) continue;
    Table restored(pinned_plates());  // audits its recording at the end
    restored.session().restore(*contents);
  }
  EXPECT_EQ(last_bytes, whole.size());
  EXPECT_GT(states, 30u);
}

TEST(Journal, TakesNoBrokenByteForARecord) {
  const ScratchFolder folder;
  Table table(wall_and_block());
  begin_journal(table, folder / "journal");
  table.move(kFirst, {-3, 0, 0}, 3);
  const std::string whole = *read_file(folder / "journal", 1 << 20);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ 0x40);
    const std::optional<JournalContents> contents = parse_journal(broken);
    EXPECT_LE(contents ? contents->whole_bytes : 0, i);
  }
}

TEST(Journal, GoesOnBehindATornTail) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "journal";
  {
    Table table(wall_and_block());
    begin_journal(table, file);
    table.move(kFirst, {-3, 0, 0}, 3);
    table.move(kFirst, {-3, 0, 0}, 3);
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 5);
  Table table(wall_and_block());
  const JournalContents torn = contents_of(file);
  table.session().restore(torn);
  EXPECT_EQ(table.pose(0).position.x, -6);  // all frames are restored, the end of the drag is not
  Result<std::unique_ptr<Journal>> journal = Journal::go_on(file, torn);
  ASSERT_TRUE(journal.ok());
  table.session().set_journal(std::move(*journal));
  table.move(kFirst, {0, 1, 0}, 1);
  const JournalContents contents = contents_of(file);
  ASSERT_EQ(contents.done_count, 3u);
  EXPECT_EQ(contents.entries[2].frames.back().pose.position, (Vec3{-6, 1, 0}));
}

TEST(Journal, WritesARestoredSessionDownInANewOne) {
  const ScratchFolder folder;
  Table table(wall_and_block()), other(wall_and_block());
  begin_journal(table, folder / "a");
  table.move(kFirst, {-3, 0, 0}, 3);
  table.move(kFirst, {0, 3, 0}, 3);
  ASSERT_TRUE(table.session().undo().ok());
  begin_journal(other, folder / "b");
  other.session().restore(contents_of(folder / "a"));
  other.session().rewrite_journal();
  const JournalContents a = contents_of(folder / "a"), b = contents_of(folder / "b");
  EXPECT_EQ(a.entries, b.entries);
  EXPECT_EQ(a.done_count, b.done_count);
}

TEST(Journal, KeepsTheSessionOfBeforeUntilItIsReplacedAsAWhole) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "journal";
  Table table(wall_and_block());
  begin_journal(table, file);
  table.move(kFirst, {-3, 0, 0}, 3);
  table.move(kFirst, {0, 3, 0}, 3);
  ASSERT_TRUE(table.session().undo().ok());
  const JournalContents before = contents_of(file);
  const std::size_t size = read_file(file, 1 << 24)->size();
  table.session().rewrite_journal();
  const std::string bytes = *read_file(file, 1 << 24);
  ASSERT_GT(bytes.size(), size);
  for (std::size_t end = size; end <= bytes.size(); ++end) {
    const std::optional<JournalContents> cut = parse_journal(std::string_view(bytes).substr(0, end));
    ASSERT_TRUE(cut.has_value());
    EXPECT_EQ(cut->entries, before.entries) << end;
    EXPECT_EQ(cut->done_count, 1u) << end;
    EXPECT_EQ(cut->whole_bytes, end < bytes.size() ? size : end);
    EXPECT_EQ(cut->invalid, "") << end;
  }
}

TEST(Journal, RefusesToBeReplacedByNoValidSession) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "journal";
  Table table(wall_and_block());
  begin_journal(table, file);
  table.move(kFirst, {-3, 0, 0}, 3);
  table.session().close_journal();
  const JournalContents before = contents_of(file);
  SessionEntry elsewhere = before.entries.front();
  elsewhere.frames.front().pose.position.x += 1;  // where the component is not
  Result<std::unique_ptr<Journal>> journal = Journal::go_on(file, before);
  ASSERT_TRUE(journal.ok());
  (*journal)->replace({&elsewhere, 1}, 1);
  const JournalContents after = contents_of(file);
  EXPECT_EQ(after.entries, before.entries);
  EXPECT_EQ(after.invalid, "a motion does not start where its components are");
}

TEST(Journal, IsForOneProcessAtATime) {
  const ScratchFolder folder;
  const Result<std::unique_ptr<Journal>> first = Journal::create(folder / "journal", {});
  ASSERT_TRUE(first.ok());
  EXPECT_FALSE(Journal::create(folder / "journal", {}).ok());
  EXPECT_FALSE(Journal::create(folder / "nowhere/journal", {}).ok());
}

TEST(Journal, SaysWhenItWasClosedInOrder) {
  const ScratchFolder folder;
  Table table(wall_and_block());
  begin_journal(table, folder / "journal");
  table.move(kFirst, {-3, 0, 0}, 3);
  EXPECT_FALSE(contents_of(folder / "journal").is_closed);
  Result<std::unique_ptr<Journal>> closed = Journal::create(folder / "other", table.session().journal_header());
  (*closed)->close();
  EXPECT_TRUE(contents_of(folder / "other").is_closed);
}

}  // namespace
}  // namespace dismantle
