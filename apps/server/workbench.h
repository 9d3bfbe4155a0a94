// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/instructions_request.h"
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

/// The session that the clients share, with the commands, inputs, poses and states of docs/wire.md. Independent of
/// network and threads: all functions are for the engine loop's thread.
class Workbench {
 public:
  /// The clock of steps.
  using Clock = std::chrono::steady_clock;

  /// Starts a search, whose result is passed to apply_search_result() later. @return the job's number. Errors: Usage if
  /// another job is running.
  using StartSearch = std::function<Result<std::uint32_t>(const SearchRequest&)>;

  /// Starts making work instructions, which are passed to keep_instructions() later. @return as StartSearch
  using StartInstructions = std::function<Result<std::uint32_t>(InstructionsRequest)>;

  /// @param roots folders in which recordings are saved and paths are read
  /// @param journals the folder of the sessions' journals; none: not stored
  Workbench(Roots roots, std::optional<std::filesystem::path> journals, StartSearch start_search,
            StartInstructions start_instructions)
      : roots_(std::move(roots)),
        journals_(std::move(journals)),
        start_search_(std::move(start_search)),
        start_instructions_(std::move(start_instructions)) {}
  /// Closes the journal.
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Replaces the assembly; the previous session ends normally. @pre the model is loaded
  void set_model(Model model);
  /// The open assembly; null if there is none.
  const Model* model() const { return model_ ? &*model_ : nullptr; }

  /// Executes a command of a client that may send it. @return the members of the reply. Errors: Usage if the command is
  /// malformed or not possible now, Failed if a file cannot be written.
  Result<Json> execute(const Json& command);
  /// True if only the client in control may send the command: it changes the session, or is unknown.
  static bool needs_control(std::string_view command);

  /// True during a drag.
  bool is_dragging() const { return model_ && session().activity() == SessionActivity::Drag; }
  /// Ends a drag or an automatic motion and pauses a playback: the client in control changes.
  void stop_motion();
  /// Applies the result of a search: a plan becomes the guide, a removal path is followed, reasons are reported in the
  /// state. Ignored if another assembly is open.
  void apply_search_result(const SearchResult& result);
  /// Keeps work instructions of `assembly` for instructions(). Ignored if another assembly is open.
  void keep_instructions(const Assembly& assembly, MadeInstructions made);
  /// The work instructions of the open assembly that were made last; null if there are none.
  const MadeInstructions* instructions() const { return instructions_ ? &*instructions_ : nullptr; }
  /// Opens a path file as the guide. Errors: as read_path and Session::set_guide; Usage if nothing is open.
  Result<Done> open_guide(const std::filesystem::path& file, const std::string& name);

  /// Sets the target pose of the drag; ignored if it is of another drag, or older than the last input.
  void set_input(const TargetMessage& target);
  /// Sets the target velocity of the drag; ignored as above. Valid for 150 ms.
  void set_input(const RateMessage& rate);
  /// True if step() has something to do.
  bool needs_step() const;
  /// Makes one step of the drag, the automatic motion or the playback. @return the struct to send; none if nothing
  /// moves
  std::optional<PoseMessage> step(Clock::time_point now);

  /// Minimum interval between two steps of the present activity.
  std::chrono::microseconds step_interval() const;
  /// The recording as a path file (docs/formats.md); none if no assembly is open.
  std::optional<std::string> recording_text() const;
  /// A name for the file of the recording, after that of the assembly.
  std::string recording_name() const;
  /// Makes the next take_state() return the state even if it has not changed: for new clients.
  void request_state() { changed_ = true; }
  /// The event `state`, if it has changed since the last call.
  std::optional<std::string> take_state();
  /// The contents of the guide's file; none if there is no guide.
  std::optional<std::string> guide_text() const;
  /// Sets a warning for the users; replaces one that has not been taken yet.
  void warn(std::string text) { warning_ = std::move(text); }
  /// The warning, if there is a new one.
  std::optional<std::string> take_warning() { return std::exchange(warning_, {}); }
  /// Statistics of the steps.
  StepStatistics& statistics() { return statistics_; }

 private:
  friend class WorkbenchCommands;

  Result<Json> search(SearchRequest request);
  void follow_removals(const SearchResult& result);
  void drop_outdated_result();
  Result<Json> grab(const std::vector<ComponentId>& components);
  void drop_input();
  Pose target_pose(Clock::time_point now);
  bool moves_automatically() const;
  StepResult drag(Clock::time_point now);
  StepResult advance(Clock::time_point now);
  void check_journal();
  PoseMessage pose_message(const StepResult& step, Clock::time_point now) const;
  std::vector<ContactMessage> contact_messages(const StepResult& step) const;
  Session& session() { return *model_->session; }
  const Session& session() const { return *model_->session; }

  Roots roots_;
  JournalStore journals_;
  StartSearch start_search_;
  StartInstructions start_instructions_;
  std::optional<MadeInstructions> instructions_;
  std::optional<Model> model_;
  std::optional<SearchResult> search_result_;  ///< Of the last search, while it is valid.
  bool is_resumed_ = false, is_resumable_ = false;
  bool journal_failed_ = false;
  std::optional<std::string> warning_;
  bool changed_ = false;
  std::uint32_t state_number_ = 0;
  std::uint32_t grip_ = 0;  ///< Number of the last grab.
  Clock::time_point grabbed_at_, rate_at_, stepped_at_;
  std::optional<TargetMessage> target_;
  std::optional<RateMessage> rate_;
  std::uint32_t number_ = 0;  ///< Of the newest input of the drag.
  bool settled_ = true;       ///< Further steps with this input would not move the set.
  StepStatistics statistics_;
};

}  // namespace dismantle::server
