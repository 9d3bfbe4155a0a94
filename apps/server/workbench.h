// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "apps/server/session_json.h"
#include "apps/server/step_statistics.h"
#include "apps/server/wire.h"

#include <chrono>
#include <optional>
#include <string>
#include <variant>

namespace dismantle::server {

/// The session that the server's clients share, as docs/wire.md tells of it: commands and targets in, poses and states
/// out. Knows no network and no threads; the engine loop calls it.
class Workbench {
 public:
  using Clock = std::chrono::steady_clock;

  /// Opens another assembly; the session before is gone.
  void adopt(Model model);
  const Model* model() const { return model_ ? &*model_ : nullptr; }

  /// Does a command of a client in control. @return the answer's members, or the error
  Result<Json> execute(const Json& command);
  /// Whether a command changes nothing, so that every client may give it.
  static bool is_question(std::string_view command);

  bool is_dragging() const { return model_ && session().activity() == SessionActivity::Drag; }
  /// Lets go of what is in hand: its client is gone.
  void let_go();

  /// What the hand asks for; passed over where it is not of the set in hand, or older than what is known.
  void set_wanted(const TargetMessage& target);
  void set_wanted(const RateMessage& rate);
  /// Whether step() has something to do.
  bool wants_step() const;
  /// Moves on by one step. @return the struct to send, or nothing where it is as before
  std::optional<PoseMessage> step(Clock::time_point now);

  /// The recording as FORMATS has it and a name for its file; none where nothing is open.
  std::optional<std::string> recording_text() const;
  std::string recording_name() const;
  /// The event `state`, where it has changed since it was taken last.
  std::optional<std::string> take_state();
  StepStatistics& statistics() { return statistics_; }

 private:
  friend class WorkbenchCommands;

  Result<Json> hold(const std::vector<ComponentId>& components);
  void drop_targets();
  Pose wanted_pose(Clock::time_point now);
  PoseMessage pose_message(const StepResult& step, Clock::time_point now) const;
  std::vector<ContactMessage> contact_messages(const StepResult& step) const;
  Session& session() { return *model_->session; }
  const Session& session() const { return *model_->session; }

  std::optional<Model> model_;
  bool changed_ = false;
  std::uint32_t state_number_ = 0;
  std::uint32_t grip_ = 0;  ///< Of the last hold.
  Clock::time_point held_at_, rate_at_, stepped_at_;
  std::optional<TargetMessage> target_;
  std::optional<RateMessage> rate_;
  std::uint32_t number_ = 0;  ///< Of the newest target or rate.
  bool settled_ = true;       ///< The last step to the present target got no further.
  StepStatistics statistics_;
};

}  // namespace dismantle::server
