// SPDX-License-Identifier: Apache-2.0
// Journals that were crafted or damaged.
#include "dismantle/session/restored_state.h"

#include "dismantle/session/journal_records.h"
#include "tests/session/session_table.h"

#include <limits>

namespace dismantle {
namespace {

using scenes::kFirst;
using scenes::kSecond;
using scenes::pinned_plates;
using scenes::Table;
using scenes::wall_and_block;

/// An entry that moves components along a straight line.
SessionEntry shift(const std::vector<ComponentId>& components, const Vec3& from, const Vec3& to) {
  SessionEntry entry{"move", components, {{0, {from, {}}}, {1, {to, {}}}}, {}, {}};
  entry.removed_before.resize(components.size());
  return entry;
}

/// A journal of entries, the last of which is in progress.
std::string journal_of(const JournalHeader& header, const std::vector<SessionEntry>& entries) {
  std::string bytes = header_record(header);
  for (const SessionEntry& entry : entries) {
    bytes += begin_record(entry);
    if (entry.frames.size() > 1) bytes += frames_record({entry.frames.data() + 1, entry.frames.size() - 1});
    if (&entry != &entries.back()) bytes += end_record(entry);
  }
  return bytes;
}

const JournalHeader kHeader{"a.obj", "0123", 2, 0.01};

/// Expects that of two entries only the first is taken.
void expect_refused(const SessionEntry& second, const std::string& why) {
  const auto contents = parse_journal(journal_of(kHeader, {shift(kFirst, {}, {-3, 0, 0}), second}));
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->invalid, why);
  EXPECT_EQ(contents->done_count, 1u);
  EXPECT_EQ(contents->entries.size(), 1u);
}

TEST(JournalRecords, OfPosesThatAreNoneAreRefused) {
  SessionEntry entry = shift(kFirst, {-3, 0, 0}, {-4, 0, 0});
  for (const double broken : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    entry.frames[1].pose.position.y = broken;
    expect_refused(entry, "a pose is not finite");
  }
  entry = shift(kFirst, {-3, 0, 0}, {-4, 0, 0});
  entry.frames[1].time = std::numeric_limits<double>::quiet_NaN();
  expect_refused(entry, "a pose is not finite");
  for (const Quat& broken : {Quat{0, 0, 0, 0}, Quat{1, 1, 0, 0}, Quat{1.01, 0, 0, 0}}) {
    entry = shift(kFirst, {-3, 0, 0}, {-4, 0, 0});
    entry.frames[1].pose.rotation = broken;
    expect_refused(entry, "a rotation is not of unit length");
    std::swap(entry.frames[0].pose.rotation, entry.frames[1].pose.rotation);
    expect_refused(entry, "a rotation is not of unit length");
  }
}

TEST(JournalRecords, OfMotionsThatDoNotFollowEachOtherAreRefused) {
  expect_refused(shift(kFirst, {-2, 0, 0}, {-4, 0, 0}), "a motion does not start where its components are");
  expect_refused(shift(kSecond, {-3, 0, 0}, {-4, 0, 0}), "a motion does not start where its components are");
  SessionEntry entry = shift(kFirst, {-3, 0, 0}, {-4, 0, 0});
  entry.frames[1].time = -1;
  expect_refused(entry, "the times of a motion descend");
}

TEST(JournalRecords, OfUnknownComponentsAreRefused) {
  expect_refused(shift({ComponentId(2)}, {}, {-4, 0, 0}), "it is malformed");
  expect_refused(shift({ComponentId(0xffffffff)}, {}, {-4, 0, 0}), "it is malformed");
}

TEST(JournalRecords, FollowUndoAndRedo) {
  const SessionEntry first = shift(kFirst, {}, {-3, 0, 0}), second = shift(kFirst, {-3, 0, 0}, {-5, 0, 0});
  std::string bytes = journal_of(kHeader, {first, second}) + end_record(second);
  for (const JournalRecord kind : {JournalRecord::Undo, JournalRecord::Undo, JournalRecord::Redo})
    bytes += plain_record(kind);
  const SessionEntry third = shift(kFirst, {-3, 0, 0}, {-3, 1, 0});
  bytes += begin_record(third) + frames_record({&third.frames[1], 1}) + end_record(third);
  const auto contents = parse_journal(bytes);
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->invalid, "");
  EXPECT_EQ(contents->entries, (std::vector<SessionEntry>{first, third}));
  EXPECT_EQ(parse_journal(bytes + plain_record(JournalRecord::Redo))->invalid, "it is malformed");
}

TEST(JournalRecords, ThatWereChangedAreSaidSo) {
  std::string bytes = journal_of(kHeader, {shift(kFirst, {}, {-3, 0, 0}), shift(kSecond, {}, {9, 0, 0})});
  EXPECT_EQ(parse_journal(std::string_view(bytes).substr(0, bytes.size() - 1))->invalid, "") << "torn";
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  EXPECT_EQ(parse_journal(bytes)->invalid, "its bytes were changed");
}

/// Restores a journal in which the last of some entries ends in an invalid state. The recording is audited at the end.
void expect_restored(Assembly assembly, const std::vector<SessionEntry>& entries, std::size_t valid_count) {
  Table table(std::move(assembly));
  const auto contents = parse_journal(journal_of(table.session().journal_header(), entries));
  ASSERT_TRUE(contents);
  ASSERT_EQ(contents->done_count, entries.size()) << contents->invalid;
  const RestorableState state = table.session().restore(*contents);
  EXPECT_EQ(state.done_count, valid_count);
  EXPECT_EQ(state.too_deep.has_value(), valid_count < entries.size());
  EXPECT_EQ(table.session().done().size(), valid_count);
  EXPECT_TRUE(table.session().undone().empty());
  if (valid_count == 0) {
    EXPECT_EQ(table.poses(), std::vector<Pose>(table.poses().size()));
  } else {
    EXPECT_EQ(table.pose(entries[valid_count - 1].components[0].value), entries[valid_count - 1].frames.back().pose);
  }
}

TEST(RestoredState, IsTheLastThatIsValid) {
  const SessionEntry free = shift(kFirst, {}, {-3, 0, 0});
  // Into the wall, on within it, and something else beside.
  const SessionEntry into = shift(kFirst, {-3, 0, 0}, {10.6, 0, 0}), on = shift(kFirst, {10.6, 0, 0}, {10.7, 0, 0});
  expect_restored(wall_and_block(), {free}, 1);
  expect_restored(wall_and_block(), {free, into}, 1);
  expect_restored(wall_and_block(), {free, into, on}, 1);
  expect_restored(wall_and_block(), {shift(kFirst, {}, {10.7, 0, 0})}, 0);
  expect_restored(wall_and_block(), {free, shift(kSecond, {}, {-14, 0, 0})}, 1);
}

TEST(RestoredState, MayTouch) {
  expect_restored(wall_and_block(), {shift(kFirst, {}, {10.5, 0, 0})}, 1);
  expect_restored(wall_and_block(), {shift(kFirst, {}, {10.509, 0, 0})}, 1);
  expect_restored(pinned_plates(), {shift(kFirst, {}, {0, 0, 5})}, 1);
  expect_restored(pinned_plates(), {shift(kFirst, {}, {0, 0, 40}), shift(kFirst, {0, 0, 40}, {0.5, 0, 5})}, 1);
}

}  // namespace
}  // namespace dismantle
