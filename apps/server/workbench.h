// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/journal_store.h"
#include "apps/server/model.h"
#include "apps/server/roots.h"
#include "apps/server/search.h"
#include "apps/server/session_json.h"
#include "apps/server/step_statistics.h"
#include "apps/server/wire.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace dismantle::server {

/// The session that the server's clients share, as docs/wire.md tells of it: commands and targets in, poses and states
/// out. Knows no network and no threads; the engine loop calls it.
class Workbench {
 public:
  using Clock = std::chrono::steady_clock;

  /// Begins a search whose finding is given to take_finding() later. @return the job's number
  using BeginSearch = std::function<Result<std::uint32_t>(const Search&)>;

  /// @param roots where recordings are saved and paths are read
  /// @param journals the folder of the sessions' journals; none: they are not kept
  Workbench(Roots roots, std::optional<std::filesystem::path> journals, BeginSearch begin_search)
      : roots_(std::move(roots)), journals_(std::move(journals)), begin_search_(std::move(begin_search)) {}
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Opens another assembly; the session before ends in order.
  void adopt(Model model);
  const Model* model() const { return model_ ? &*model_ : nullptr; }

  /// Does a command of a client in control. @return the answer's members, or the error
  Result<Json> execute(const Json& command);
  /// True if a command changes nothing, so that every client may send it.
  static bool is_question(std::string_view command);

  bool is_dragging() const { return model_ && session().activity() == SessionActivity::Drag; }
  /// Ends the drag and the automatic motion of a client that has gone.
  void let_go();
  /// Uses the result of a search: a plan becomes the guide, a path is followed, a reason is reported.
  void take_finding(const Finding& finding);
  /// Opens a path file as the guide. Errors: as read_path and Session::set_guide; Usage if nothing is open.
  Result<Done> open_guide(const std::filesystem::path& file, const std::string& name);

  /// Sets the wanted pose; ignored if it is not for the dragged set, or older than the last one.
  void set_wanted(const TargetMessage& target);
  void set_wanted(const RateMessage& rate);
  /// True if step() has something to do.
  bool wants_step() const;
  /// Moves on by one step. @return the struct to send, or nothing where it is as before
  std::optional<PoseMessage> step(Clock::time_point now);

  /// Between two steps of what goes on.
  std::chrono::microseconds step_interval() const;
  /// The recording as docs/formats.md has it and a name for its file; none where nothing is open.
  std::optional<std::string> recording_text() const;
  std::string recording_name() const;
  /// Has the next take_state() give one even where nothing has changed: for clients that are new.
  void tell_state() { changed_ = true; }
  /// The event `state`, where it has changed since it was taken last.
  std::optional<std::string> take_state();
  /// The guide's file; none where there is no guide.
  std::optional<std::string> guide_text() const;
  /// A warning for the users, where there is a new one.
  void warn(std::string text) { warning_ = std::move(text); }
  std::optional<std::string> take_warning() { return std::exchange(warning_, {}); }
  StepStatistics& statistics() { return statistics_; }

 private:
  friend class WorkbenchCommands;

  Result<Json> search(Search wanted);
  void go_out(const Finding& finding);
  void forget_old_finding();
  Result<Json> hold(const std::vector<ComponentId>& components);
  void drop_targets();
  Pose wanted_pose(Clock::time_point now);
  bool moves_by_itself() const;
  StepResult drag(Clock::time_point now);
  StepResult advance(Clock::time_point now);
  void watch_journal();
  PoseMessage pose_message(const StepResult& step, Clock::time_point now) const;
  std::vector<ContactMessage> contact_messages(const StepResult& step) const;
  Session& session() { return *model_->session; }
  const Session& session() const { return *model_->session; }

  Roots roots_;
  JournalStore journals_;
  BeginSearch begin_search_;
  std::optional<Model> model_;
  std::optional<Finding> finding_;  ///< Of the last search, while it is true.
  bool is_resumed_ = false, is_resumable_ = false;
  bool journal_failed_ = false;
  std::optional<std::string> warning_;
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
