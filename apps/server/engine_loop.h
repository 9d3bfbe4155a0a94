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
  /// The events `model`, `state` and `log`.
  enum class Kind { Model, State, Log };
  Kind kind = Kind::State;   ///< Which event it is.
  bool is_dragging = false;  ///< State: a set is being dragged.
  std::string text;          ///< The JSON message.
};

/// Receives the events of an engine loop, on the loop's thread.
class EngineListener {
 public:
  virtual ~EngineListener() = default;
  /// Receives a struct `pose`, encoded. It may be dropped when a newer one follows.
  virtual void on_pose(std::string bytes) = 0;
  /// Receives an event. Events must not be dropped.
  virtual void on_event(EngineEvent event) = 0;
};

/// The thread that owns the workbench. It makes at most a thousand steps a second while something moves, and sleeps
/// while nothing does. Separate from the network's thread, so that neither waits for the other. All public functions
/// may be called from any thread, unless they say otherwise.
class EngineLoop {
 public:
  /// Work for the loop's thread.
  using Task = std::function<void(Workbench&)>;

  /// Starts the thread. `listener`, and `jobs`, which runs the searches, must outlive the loop. The other parameters
  /// are those of Workbench.
  EngineLoop(EngineListener& listener, Roots roots, std::optional<std::filesystem::path> journals, Jobs& jobs);
  ~EngineLoop();
  EngineLoop(const EngineLoop&) = delete;
  EngineLoop& operator=(const EngineLoop&) = delete;

  /// Queues a task, which runs on the loop's thread; tasks run in order. @return false if too many are queued
  bool post(Task task);
  /// As post(), without the limit on queued tasks: for results of jobs, of which there is one at a time, and for HTTP
  /// requests, of which each connection has one.
  void post_always(Task task);
  /// Queues a task that has the event `state` emitted even if the state has not changed, unless one is queued already.
  void request_state();
  /// Sets the target or the velocity of the dragged set; replaces an input that has not been processed yet.
  void set_input(const DragInput& input);
  /// Emits the event `state` if the state has changed, and a `log` event for a new warning. Called by tasks whose reply
  /// must come after the state. @pre called on the loop's thread
  void publish_state();
  /// Replaces the model and emits the event `model`.
  void set_model(Model model);
  /// Runs the queued tasks and ends the thread. Safe to call twice.
  void stop();

 private:
  using Clock = Workbench::Clock;
  struct PendingInput {
    DragInput message;
    Clock::time_point arrival;
  };

  /// Starts a job that runs the search and applies its result on the loop's thread.
  Result<std::uint32_t> start_search(Jobs& jobs, const SearchRequest& request);
  /// Starts a job that makes work instructions and keeps them in the workbench.
  Result<std::uint32_t> start_instructions(Jobs& jobs, InstructionsRequest request);
  void run();
  /// Waits for tasks, an input or the next step, and takes the tasks and the input; false if the loop must end.
  bool take_work(std::deque<Task>& tasks, std::optional<PendingInput>& input);
  void make_step(Clock::time_point now);

  EngineListener& listener_;
  Workbench bench_;  ///< Of the loop's thread.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> tasks_;
  std::optional<PendingInput> input_;
  bool stopping_ = false, state_requested_ = false;
  Clock::time_point next_step_ = Clock::now();
  std::optional<Clock::time_point> input_arrival_;  ///< Of the newest input, until a step has been made for it.
  std::thread thread_;
};

}  // namespace dismantle::server
