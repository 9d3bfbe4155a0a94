// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/certificate_engine.h"
#include "dismantle/core/result.h"
#include "dismantle/session/session_entry.h"
#include "dismantle/session/visibility.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// What moves in a session just now.
enum class SessionActivity {
  Idle,
  Drag,  ///< A set is in hand.
};

/// An assembly that a person takes apart: a set in hand, collision handling by the method `certificates`, a recording
/// of everything that was let happen, undo and redo. Whatever it holds satisfies the guarantee of DESIGN section 3. The
/// same calls give the same session, bit for bit. For one thread at a time.
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
  SessionActivity activity() const { return activity_; }
  /// The set that moves; empty where nothing does.
  Span<const ComponentId> moving() const { return moving_; }
  /// Whether it was taken away.
  bool is_removed(ComponentId c) const { return removed_[c.value]; }
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
  /// The recording as FORMATS has it, with what the drag in hand has made so far.
  Path recording() const;
  /// Everything assembled, nothing recorded, nothing hidden.
  void reset();

 private:
  std::unique_ptr<CertificateEngine> make_engine(const PairList& embedded) const;
  PairList embedded() const;
  Result<Done> check_set(Span<const ComponentId> components) const;
  SessionEntry new_entry(std::string_view verb, Span<const ComponentId> components) const;
  bool finish_entry();
  /// Puts the entry's set where its frame is, with these pairs embedded.
  void put(const SessionEntry& entry, const Frame& frame, const PairList& embedded);
  void be_idle();

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
};

/// "screw", "screw and jaw", "screw and 3 more": for labels.
std::string names_of(const Assembly& assembly, Span<const ComponentId> components);

}  // namespace dismantle
