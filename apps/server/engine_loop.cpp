// SPDX-License-Identifier: Apache-2.0
#include "apps/server/engine_loop.h"

namespace dismantle::server {

namespace {

constexpr std::size_t kMaxTasks = 1000;

}  // namespace

EngineLoop::EngineLoop(EngineListener& listener, Roots roots, std::optional<std::filesystem::path> journals, Jobs& jobs)
    : listener_(listener),
      bench_(
          std::move(roots), std::move(journals),
          [this, &jobs](const SearchRequest& request) { return start_search(jobs, request); },
          [this, &jobs](InstructionsRequest request) { return start_instructions(jobs, std::move(request)); }),
      thread_([this] { run(); }) {}

EngineLoop::~EngineLoop() {
  stop();
}

Result<std::uint32_t> EngineLoop::start_search(Jobs& jobs, const SearchRequest& request) {
  return jobs.start(search_name(request), [this, request](const ProgressCallback& progress) -> Result<Jobs::Outcome> {
    Result<SearchResult> found = run_search(request, progress);
    if (!found) return found.error();
    const bool is_cancelled = found->cancelled;
    return Jobs::Outcome{[this, result = std::move(*found)] {
                           post_always([result](Workbench& bench) { bench.apply_search_result(result); });
                         },
                         is_cancelled};
  });
}

Result<std::uint32_t> EngineLoop::start_instructions(Jobs& jobs, InstructionsRequest request) {
  // std::function requires copyable captures.
  auto shared = std::make_shared<const InstructionsRequest>(std::move(request));
  return jobs.start("Work instructions", [this, shared](const ProgressCallback& progress) -> Result<Jobs::Outcome> {
    Result<MadeInstructions> made = make_instructions(*shared, progress);
    if (!made) return made.error();
    return Jobs::Outcome{[this, shared, result = std::move(*made)] {
      post_always([shared, result](Workbench& bench) { bench.keep_instructions(*shared->assembly, result); });
    }};
  });
}

bool EngineLoop::post(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() >= kMaxTasks) return false;
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
  return true;
}

void EngineLoop::post_always(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
}

void EngineLoop::request_state() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(state_requested_, true)) return;
    tasks_.push_back([](Workbench& bench) { bench.request_state(); });
  }
  wake_.notify_one();
}

void EngineLoop::set_input(const DragInput& input) {
  {
    const std::lock_guard lock(mutex_);
    input_ = PendingInput{input, Clock::now()};
  }
  wake_.notify_one();
}

void EngineLoop::set_model(Model model) {
  // std::function requires copyable captures.
  post_always([this, shared = std::make_shared<Model>(std::move(model))](Workbench& bench) {
    bench.set_model(std::move(*shared));
    listener_.on_event({EngineEvent::Kind::Model, false, text_of(model_json(*bench.model()))});
  });
}

void EngineLoop::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

bool EngineLoop::take_work(std::deque<Task>& tasks, std::optional<PendingInput>& input) {
  std::unique_lock lock(mutex_);
  const auto has_work = [this] { return stopping_ || !tasks_.empty() || input_; };
  if (!bench_.needs_step()) {
    wake_.wait(lock, has_work);
  } else {
    wake_.wait_until(lock, next_step_, [this] { return stopping_ || !tasks_.empty(); });
  }
  tasks.swap(tasks_);
  state_requested_ = false;
  input = std::exchange(input_, {});
  return !stopping_ || !tasks.empty();
}

void EngineLoop::publish_state() {
  if (std::optional<std::string> state = bench_.take_state())
    listener_.on_event({EngineEvent::Kind::State, bench_.is_dragging(), std::move(*state)});
  if (const std::optional<std::string> warning = bench_.take_warning())
    listener_.on_event(
        {EngineEvent::Kind::Log, false, text_of(Json{{"event", "log"}, {"level", "warning"}, {"text", *warning}})});
}

void EngineLoop::make_step(Clock::time_point now) {
  next_step_ = now + bench_.step_interval();
  std::optional<PoseMessage> pose = bench_.step(now);
  if (!pose) return;
  const Clock::time_point end = Clock::now();
  if (input_arrival_)
    bench_.statistics().add_latency(std::chrono::duration<double, std::micro>(end - *input_arrival_).count());
  input_arrival_.reset();
  pose->steps_per_second = static_cast<float>(bench_.statistics().steps_per_second(end));
  listener_.on_pose(encode(*pose));
}

void EngineLoop::run() {
  std::deque<Task> tasks;
  std::optional<PendingInput> input;
  while (take_work(tasks, input)) {
    if (input) {
      std::visit([this](const auto& message) { bench_.set_input(message); }, input->message);
      input_arrival_ = input->arrival;
    }
    // The input before a command is processed first: the last target counts on release.
    if (!tasks.empty() && input_arrival_) make_step(Clock::now());
    for (const Task& task : tasks) task(bench_);
    tasks.clear();
    publish_state();
    if (const Clock::time_point now = Clock::now(); now >= next_step_) make_step(now);
    publish_state();  // an automatic motion may have ended
    if (!bench_.needs_step()) input_arrival_.reset();
  }
}

}  // namespace dismantle::server
