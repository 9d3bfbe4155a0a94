// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/jobs.h"
#include "apps/server/workbench.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace dismantle::server {

/// An event of docs/wire.md.
struct EngineEvent {
  enum class Kind { Model, State, Log };
  Kind kind = Kind::State;
  bool is_dragging = false;  ///< State: a set is being dragged.
  std::string text;
};

/// Receives the events of an engine loop, on the loop's thread.
class EngineListener {
 public:
  virtual ~EngineListener() = default;
  /// A struct `pose`; only the newest matters.
  virtual void on_pose(std::string bytes) = 0;
  /// None may be lost.
  virtual void on_event(EngineEvent event) = 0;
};

/// The thread that owns the workbench: at most a thousand steps a second while something moves, asleep while nothing
/// does. Apart from the network, so that neither waits for the other.
class EngineLoop {
 public:
  using Task = std::function<void(Workbench&)>;

  /// Starts the thread. `listener` and `jobs`, which searches are done by, must outlive the loop. The others: as of
  /// Workbench.
  EngineLoop(EngineListener& listener, Roots roots, std::optional<std::filesystem::path> journals, Jobs& jobs);
  ~EngineLoop();
  EngineLoop(const EngineLoop&) = delete;
  EngineLoop& operator=(const EngineLoop&) = delete;

  /// Has the task done on the loop's thread; tasks are done in order. @return false where too many wait already
  bool post(Task task);
  /// As post(), for the few tasks that must not be refused.
  void post_always(Task task);
  /// Replaces the target that the loop has not looked at yet.
  void set_wanted(const std::variant<TargetMessage, RateMessage>& wanted);
  /// Tells the listener of the state, where it has changed. For tasks that have to say so before they answer.
  void publish_state();
  /// Opens a model and tells the listener.
  void adopt(Model model);
  /// Ends the thread after the tasks that wait. Safe to call twice.
  void stop();

 private:
  using Clock = Workbench::Clock;
  struct Wanted {
    std::variant<TargetMessage, RateMessage> message;
    Clock::time_point arrived;
  };

  Result<std::uint32_t> search(Jobs& jobs, const Search& wanted);
  void run();
  /// Waits for something to do and takes it; false where the loop shall end.
  bool take_work(std::deque<Task>& tasks, std::optional<Wanted>& wanted);
  void make_step(Clock::time_point now);

  EngineListener& listener_;
  Workbench bench_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> tasks_;
  std::optional<Wanted> wanted_;
  bool stopping_ = false;
  Clock::time_point next_step_ = Clock::now();
  std::optional<Clock::time_point> unanswered_;  ///< When the target came that no step was made for.
  std::thread thread_;
};

}  // namespace dismantle::server
