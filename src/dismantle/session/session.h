// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/session/exit_search.h"
#include "dismantle/session/journal.h"
#include "dismantle/session/playback.h"
#include "dismantle/session/restored_state.h"
#include "dismantle/session/session_entry.h"
#include "dismantle/session/visibility.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The present activity of a session.
enum class SessionActivity {
  Idle,
  Drag,       ///< The user holds a set.
  Automatic,  ///< A set moves by itself: it is taken out or put back.
  Playback,   ///< A recording or a guide is open.
};

/// The kinds of automatic motions.
enum class AutomaticKind { TakeOut, PutBack };

/// A removal of a set, planned beforehand.
struct Removal {
  std::vector<ComponentId> components;  ///< The moving set.
  Pose from;                            ///< Pose of the set for which the path was planned.
  /// The path as motions from `from`, world frame; the first is the identity. If the set has been moved since as part
  /// of a body that was taken out, they are relative to that body.
  std::vector<Frame> frames;
  Vec3 exit;  ///< Unit: direction in which it then moves to its parking position; zero: it stays at the end.
};

/// A path file that guides the user.
struct Guide {
  std::string name;   ///< Of the file.
  std::string text;   ///< Contents of the file.
  Timeline timeline;  ///< Its moves.
};

/// An engine that computes drags in place of the session's own, and what to call it.
struct DragEngine {
  std::unique_ptr<MotionEngine> engine;          ///< Over the session's assembly and pair states; null: its own engine.
  std::string method = "certificates";           ///< As `--method` names it.
  std::string device = "cpu";                    ///< "cpu", or the name of the CUDA device.
  std::shared_ptr<const DeviceFailure> failure;  ///< Of the device, while it works; null on the CPU.
};

/// An interactive disassembly session: dragging with collision handling by the method `certificates` or another one, a
/// recording of everything that happened, undo and redo. Every motion satisfies docs/guarantee.md. Equal calls give
/// equal sessions, bit for bit. Not thread-safe.
class Session {
 public:
  /// A session with everything assembled. `assembly` must outlive it.
  Session(const Assembly& assembly, PairStates pairs, const CertificateOptions& options = {});

  /// The assembly.
  const Assembly& assembly() const { return *assembly_; }
  /// Pair states in the assembled state.
  const PairStates& pairs() const { return pairs_; }
  /// The present pose of every component.
  Span<const Pose> poses() const { return engine_->poses(); }
  /// The engine, for queries about its moving set.
  const CertificateEngine& engine() const { return *engine_; }
  /// Computes drags by another engine from now on; where it cannot slide, drags touch. Everything else (taking out,
  /// putting back, playback, contacts, clearance) stays with the session's own. Both hold docs/guarantee.md.
  /// @pre nothing is dragged
  void set_drag_engine(DragEngine engine);
  /// The engine of drags.
  const DragEngine& drag_engine() const { return drag_engine_; }
  /// Options of the engine.
  const CertificateOptions& options() const { return options_; }
  /// The present activity.
  SessionActivity activity() const { return activity_; }
  /// The moving set; empty if nothing moves.
  Span<const ComponentId> moving() const { return playback_ ? playback_->moving() : Span<const ComponentId>(moving_); }
  /// True if the component is removed; in a playback, at its present time.
  bool is_removed(ComponentId c) const { return playback_ ? played_removed_[c.value] : removed_[c.value]; }
  /// Which components are drawn.
  Visibility& visibility() { return visibility_; }
  /// Which components are drawn.
  const Visibility& visibility() const { return visibility_; }

  /// Starts to drag a set; a previous drag is released. Errors: Usage if the set is empty, its components have
  /// different poses, or one is hidden or removed.
  Result<Done> hold(Span<const ComponentId> components);
  /// Moves the dragged set towards `target` as far as the response allows, and records the motion.
  /// @param time since hold() [s]; not decreasing, else the previous time is used
  /// @pre activity() is Drag
  StepResult drag(const Pose& target, double time);
  /// Ends the drag: one entry for undo, if anything moved. @return true if it did
  bool release();
  /// Ends the drag and restores the poses from before it, without an entry.
  void cancel_drag();
  /// The center of the bounding box of the moving set [mm, world]. @pre something moves
  Vec3 moving_center() const;

  /// The response of drags.
  ResponseKind response() const { return response_; }
  /// True if the engine of drags implements this response.
  bool can_respond(ResponseKind response) const {
    return drag_engine_.engine == nullptr || drag_engine_.engine->can_respond(response);
  }
  /// Sets the response of drags. @pre can_respond(response)
  void set_response(ResponseKind response) { response_ = response; }

  /// Undoes the last entry; during a drag, ends and undoes the drag. Errors: Usage if there is none.
  Result<Done> undo();
  /// Redoes the entry undone last. Errors: Usage if there is none.
  Result<Done> redo();
  /// The entries in effect, in order: the recording.
  Span<const SessionEntry> done() const { return {entries_.data(), done_count_}; }
  /// The undone entries; the next one to redo first.
  Span<const SessionEntry> undone() const { return {entries_.data() + done_count_, entries_.size() - done_count_}; }
  /// The recording as a path, including the present drag so far.
  Path recording() const;
  /// Resets: everything assembled, nothing recorded, nothing hidden.
  void reset();

  /// The header of a journal of this session.
  JournalHeader journal_header() const;
  /// Writes a journal from now on. @pre nothing is recorded, or the journal has it
  void set_journal(std::unique_ptr<Journal> journal) { journal_ = std::move(journal); }
  /// The journal; null if there is none.
  const Journal* journal() const { return journal_.get(); }
  /// Records a normal end of the session and stops writing.
  void close_journal();
  /// Restores the last valid state of a journal (last_valid_state()), without the entries after it if it is not the
  /// last one; a motion that was in progress has ended. @return the state that was restored
  /// @pre nothing is recorded; the contents' header is journal_header()
  RestorableState restore(JournalContents contents);
  /// Writes everything that is recorded to the journal, in place of what it has.
  void rewrite_journal();

  /// Starts to move a set out along `direction`, or along the shortest free direction, to outside the assembly's
  /// bounding box and clear of later removals; it then counts as removed. Errors: Usage as of hold(), and if a
  /// component blocks, with its name.
  Result<Done> take_out(Span<const ComponentId> components, const std::optional<Vec3>& direction);
  /// Starts to take sets out, one after another along planned paths, as far as each is free; each is an entry, and its
  /// components that do not move again count as removed. If one does not get out, those after it are not started.
  /// Errors: Usage as of hold(), and if a set is not at the start of its path.
  Result<Done> take_out_along(std::vector<Removal> removals);
  /// Starts to move a set back along its recorded path, reversed, as far as it is free now; it no longer counts as
  /// removed. Errors: Usage if the set is empty, its components have different poses, or it is in its assembled pose.
  Result<Done> put_back(Span<const ComponentId> components);
  /// The kind of the automatic motion. @pre activity() is Automatic
  AutomaticKind automatic() const { return automatic_->kind; }
  /// Ends the automatic motion where it is; the motion so far is an entry.
  void halt();
  /// The free distances of a set along candidate directions, free ones first. Errors: Usage if the set is empty, its
  /// components have different poses, or another set is being dragged.
  Result<std::vector<FreeDirection>> free_directions(Span<const ComponentId> components);

  /// Opens a playback of the source, unless it is open, and plays; backward if `speed` is negative. A recording opens
  /// at its end, a guide at its start. Errors: Usage if there is nothing to play, or another source is open.
  Result<Done> play(PlaybackSource source, double speed);
  /// Opens a playback of the source, unless it is open, and jumps to a time [s]. Errors: as play().
  Result<Done> seek(PlaybackSource source, double time);
  /// Pauses the playback.
  void pause();
  /// Closes the playback and restores the poses from before it.
  void stop_playback();
  /// The open playback; null if there is none.
  const Playback* playback() const { return playback_ ? &*playback_ : nullptr; }

  /// Sets the guide; a playback of the previous one ends. Errors: as Timeline::of_path.
  Result<Done> set_guide(std::string name, std::string text, const Path& path);
  /// Removes the guide.
  void close_guide();
  /// The guide; null if there is none.
  const Guide* guide() const { return guide_ ? &*guide_ : nullptr; }

  /// Advances the automatic motion or playback by `dt` [s]. @pre activity() is Automatic, or Playback that plays
  StepResult advance(double dt);

 private:
  struct Automatic {
    AutomaticKind kind = AutomaticKind::TakeOut;
    std::vector<Frame> targets;
    std::size_t next = 0;
    double clock = 0;
    int stuck = 0;  ///< Number of consecutive targets that were not reached.
  };

  Result<Done> check_set(Span<const ComponentId> components) const;
  Result<Done> check_one_pose(Span<const ComponentId> components) const;
  Result<Done> check_no_playback() const;
  SessionEntry new_entry(std::string_view verb, Span<const ComponentId> components) const;
  bool finish_entry();
  void write_frames(std::size_t from);
  /// Puts the components of an entry at the pose of one of its frames.
  void put(const SessionEntry& entry, const Frame& frame);
  void begin(SessionActivity activity, std::string_view verb, std::vector<ComponentId> set);
  StepResult step_of_drag(const Pose& target);
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
  DragEngine drag_engine_;
  SessionActivity activity_ = SessionActivity::Idle;
  std::vector<ComponentId> moving_;
  Vec3 moving_center_;  ///< Of the box around the assembled set [mm].
  ResponseKind response_ = ResponseKind::Slide;
  std::optional<SessionEntry> open_;  ///< The entry in progress.
  std::vector<SessionEntry> entries_;
  std::size_t done_count_ = 0;
  std::vector<bool> removed_;
  Visibility visibility_;
  std::optional<Automatic> automatic_;
  std::vector<Removal> removals_;  ///< Pending, the next one last.
  std::optional<Playback> playback_;
  std::vector<bool> played_removed_;
  std::vector<Pose> live_poses_;  ///< Before the playback.
  std::optional<Guide> guide_;
  std::unique_ptr<Journal> journal_;
};

/// The components in ascending order, without repeats.
std::vector<ComponentId> sorted_set(Span<const ComponentId> components);

/// "screw", "screw and jaw", "screw and 3 more": for labels.
std::string names_of(const Assembly& assembly, Span<const ComponentId> components);

}  // namespace dismantle
