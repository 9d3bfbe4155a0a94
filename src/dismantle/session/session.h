// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/result.h"
#include "dismantle/session/journal.h"
#include "dismantle/session/playback.h"
#include "dismantle/session/session_entry.h"
#include "dismantle/session/visibility.h"
#include "dismantle/session/exit_search.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// What moves in a session just now.
enum class SessionActivity {
  Idle,
  Drag,       ///< A set is in hand.
  Automatic,  ///< A set goes its way by itself: it is taken out or put back.
  Playback,   ///< A recording or a guide is open.
};

/// What a set does by itself.
enum class AutomaticKind { TakeOut, PutBack };

/// How a set leaves where it stands, found beforehand.
struct Removal {
  std::vector<ComponentId> components;
  Pose from;  ///< Of the set, when the way was found.
  /// The motions that the set has made by then, world frame; the first is none. Where the set has gone elsewhere since
  /// as part of a body that was taken out before, they are relative to that body.
  std::vector<Frame> frames;
  Vec3 exit;  ///< Unit: after the way it goes on like this to a place of its own; zero: it stays at the way's end.
};

/// A path file that a session is to follow.
struct Guide {
  std::string name;
  std::string text;  ///< The file, as it was read.
  Timeline timeline;
};

/// An assembly that a person takes apart: a set in hand, collision handling by the method `certificates`, a recording
/// of everything that was let happen, undo and redo. Whatever it holds satisfies the guarantee of docs/guarantee.md.
/// The same calls give the same session, bit for bit. For one thread at a time.
class Session {
 public:
  /// Everything assembled. `assembly` must outlive the session.
  Session(const Assembly& assembly, PairStates pairs, const CertificateOptions& options = {});

  const Assembly& assembly() const { return *assembly_; }
  const PairStates& pairs() const { return pairs_; }
  /// Where every component is.
  Span<const Pose> poses() const { return engine_->poses(); }
  /// The engine, for questions about the set that it has in hand; it moves nothing.
  const CertificateEngine& engine() const { return *engine_; }
  const CertificateOptions& options() const { return options_; }
  SessionActivity activity() const { return activity_; }
  /// The set that moves; empty where nothing does.
  Span<const ComponentId> moving() const { return playback_ ? playback_->moving() : Span<const ComponentId>(moving_); }
  /// Whether it was taken away; in a playback, whether it is at that time.
  bool is_removed(ComponentId c) const { return playback_ ? played_removed_[c.value] : removed_[c.value]; }
  Visibility& visibility() { return visibility_; }
  const Visibility& visibility() const { return visibility_; }

  /// Takes a set in hand; what was in hand before is released. Errors: Usage where the set is empty or torn (different
  /// poses), or one is hidden or taken away.
  Result<Done> hold(Span<const ComponentId> components);
  /// Moves the set in hand towards `target` as far as the response lets it, and records how far it got.
  /// @param time since hold() [s]; where it is less than before, as before
  /// @pre activity() is Drag
  StepResult drag(const Pose& target, double time);
  /// Lets go: one entry for undo, where anything moved. @return whether it did
  bool release();
  /// Lets go, and goes back to where the set was taken in hand, without an entry.
  void cancel_drag();
  /// The middle of the box around the moving set [mm, world]. @pre something moves
  Vec3 moving_center() const;

  ResponseKind response() const { return response_; }
  void set_response(ResponseKind response) { response_ = response; }

  /// Takes back the last entry; in mid-drag the drag, which it ends. Errors: Usage where there is none.
  Result<Done> undo();
  /// Does again what was taken back last. Errors: Usage where there is none.
  Result<Done> redo();
  /// What undo() would take back, in order: the recording.
  Span<const SessionEntry> done() const { return {entries_.data(), done_count_}; }
  /// What redo() would do again; the next one first.
  Span<const SessionEntry> undone() const { return {entries_.data() + done_count_, entries_.size() - done_count_}; }
  /// The recording as docs/formats.md has it, with what the drag in hand has made so far.
  Path recording() const;
  /// Everything assembled, nothing recorded, nothing hidden.
  void reset();

  /// What a journal of this session says that it is of.
  JournalHeader journal_header() const;
  /// Writes down from now on. @pre nothing is recorded, or the journal has it
  void set_journal(std::unique_ptr<Journal> journal) { journal_ = std::move(journal); }
  const Journal* journal() const { return journal_.get(); }
  /// Writes that the session ended in order, and no more from then on.
  void close_journal();
  /// Is where the session was that wrote a journal; a motion that was going on then has ended. What has a journal by
  /// now writes all of it down there. @pre nothing is recorded; the contents' header is journal_header()
  void restore(JournalContents contents);

  /// Begins to move a set out along `direction`, or without one along the shortest free way, so far that it is outside
  /// the assembly's box and out of the way of those that follow; then it is taken away. Errors: Usage as of hold(), and
  /// where something is in the way, by name.
  Result<Done> take_out(Span<const ComponentId> components, const std::optional<Vec3>& direction);
  /// Begins to take sets out, one after another along ways that were found beforehand, as far as each is free; each is
  /// an entry, and those of its components that move no more afterwards are taken away. Where one does not get out,
  /// those after it do not begin. Errors: Usage as of hold(), and where a set is not where its way begins.
  Result<Done> take_out_along(std::vector<Removal> removals);
  /// Begins to move a set home along the way that it came, reversed, as far as it is free now; it is not taken away any
  /// more. Errors: Usage where the set is empty or torn, or where it is at home.
  Result<Done> put_back(Span<const ComponentId> components);
  /// What goes by itself. @pre activity() is Automatic
  AutomaticKind automatic() const { return automatic_->kind; }
  /// Ends it where it is; what it has made is an entry.
  void halt();
  /// How far a set can go straight, free ways first. Errors: Usage where the set is empty or torn, or another is in
  /// hand.
  Result<std::vector<FreeDirection>> free_directions(Span<const ComponentId> components);

  /// Opens a playback, where none of this source is open, and plays; backward where `speed` is negative. A recording
  /// opens at its end, a guide at its beginning. Errors: Usage where there is nothing to play, or another source is
  /// open.
  Result<Done> play(PlaybackSource source, double speed);
  Result<Done> seek(PlaybackSource source, double time);
  void pause();
  /// Closes it; everything is where it was before.
  void stop_playback();
  const Playback* playback() const { return playback_ ? &*playback_ : nullptr; }

  /// A path to be followed; a playback of the one before ends. Errors: of Timeline::of_path.
  Result<Done> set_guide(std::string name, std::string text, const Path& path);
  void close_guide();
  const Guide* guide() const { return guide_ ? &*guide_ : nullptr; }

  /// Moves what moves by itself on by `dt` [s]. @pre activity() is Automatic, or Playback that plays
  StepResult advance(double dt);

 private:
  struct Automatic {
    AutomaticKind kind = AutomaticKind::TakeOut;
    std::vector<Frame> targets;
    std::size_t next = 0;
    double clock = 0;
    int stuck = 0;  ///< Targets in a row that were not reached.
  };

  std::unique_ptr<CertificateEngine> make_engine(const PairList& embedded) const;
  PairList embedded() const;
  Result<Done> check_set(Span<const ComponentId> components) const;
  Result<Done> check_one_pose(Span<const ComponentId> components) const;
  Result<Done> check_no_playback() const;
  SessionEntry new_entry(std::string_view verb, Span<const ComponentId> components) const;
  bool finish_entry();
  void write_frames(std::size_t from);
  /// Puts all there, with these pairs embedded.
  void put(Span<const Pose> poses, const PairList& embedded);
  void put(const SessionEntry& entry, const Frame& frame, const PairList& embedded);
  void begin(SessionActivity activity, std::string_view verb, std::vector<ComponentId> set);
  void begin_automatic(AutomaticKind kind, std::vector<Frame> targets);
  void be_idle();
  StepResult advance_automatic(double dt);
  StepResult follow(const Frame& target);
  void finish_automatic(bool reached_end);
  void begin_next_removal();
  bool moves_again(ComponentId component) const;
  std::vector<Frame> way_back(ComponentId component) const;
  double parking_distance(const Vec3& direction) const;
  Result<Done> open_playback(PlaybackSource source);
  void put_playback();

  const Assembly* assembly_;
  PairStates pairs_;
  CertificateOptions options_;
  std::unique_ptr<CertificateEngine> engine_;
  SessionActivity activity_ = SessionActivity::Idle;
  std::vector<ComponentId> moving_;
  Vec3 moving_center_;  ///< Of the box around the assembled set [mm].
  ResponseKind response_ = ResponseKind::Slide;
  std::optional<SessionEntry> open_;  ///< Of the motion that is going on.
  std::vector<SessionEntry> entries_;
  std::size_t done_count_ = 0;
  std::vector<bool> removed_;
  Visibility visibility_;
  std::optional<Automatic> automatic_;
  std::vector<Removal> removals_;  ///< Still to come, the next one last.
  std::optional<Playback> playback_;
  std::vector<bool> played_removed_;
  std::vector<Pose> live_poses_;  ///< Before the playback.
  PairList live_embedded_;
  std::optional<Guide> guide_;
  std::unique_ptr<Journal> journal_;
};

/// Ordered, without repeats.
std::vector<ComponentId> sorted_set(Span<const ComponentId> components);

/// "screw", "screw and jaw", "screw and 3 more": for labels.
std::string names_of(const Assembly& assembly, Span<const ComponentId> components);

}  // namespace dismantle
