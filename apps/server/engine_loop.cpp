// SPDX-License-Identifier: Apache-2.0
#include "apps/server/engine_loop.h"

namespace dismantle::server {

namespace {

constexpr std::size_t kMaxTasks = 1000;

}  // namespace

EngineLoop::EngineLoop(EngineListener& listener, Roots roots, std::optional<std::filesystem::path> journals, Jobs& jobs)
    : listener_(listener),
      bench_(std::move(roots), std::move(journals),
             [this, &jobs](const Search& wanted) { return search(jobs, wanted); }),
      thread_([this] { run(); }) {}

EngineLoop::~EngineLoop() {
  stop();
}

Result<std::uint32_t> EngineLoop::search(Jobs& jobs, const Search& wanted) {
  return jobs.start(search_name(wanted), [this, wanted](const ProgressCallback& progress) -> Result<Jobs::Finish> {
    Result<Finding> found = run_search(wanted, progress);
    if (!found) return found.error();
    return Jobs::Finish([this, finding = std::move(*found)] {
      post_always([finding](Workbench& bench) { bench.take_finding(finding); });
    });
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

void EngineLoop::set_wanted(const std::variant<TargetMessage, RateMessage>& wanted) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = Wanted{wanted, Clock::now()};
  }
  wake_.notify_one();
}

void EngineLoop::adopt(Model model) {
  // std::function wants what it holds to be copyable.
  post_always([this, shared = std::make_shared<Model>(std::move(model))](Workbench& bench) {
    bench.adopt(std::move(*shared));
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

bool EngineLoop::take_work(std::deque<Task>& tasks, std::optional<Wanted>& wanted) {
  std::unique_lock lock(mutex_);
  const auto has_work = [this] { return stopping_ || !tasks_.empty() || wanted_; };
  if (!bench_.wants_step()) {
    wake_.wait(lock, has_work);
  } else {
    wake_.wait_until(lock, next_step_, [this] { return stopping_ || !tasks_.empty(); });
  }
  tasks.swap(tasks_);
  wanted = std::exchange(wanted_, {});
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
  if (unanswered_)
    bench_.statistics().add_answer(std::chrono::duration<double, std::micro>(end - *unanswered_).count());
  unanswered_.reset();
  pose->steps_per_second = static_cast<float>(bench_.statistics().steps_per_second(end));
  listener_.on_pose(encode(*pose));
}

void EngineLoop::run() {
  std::deque<Task> tasks;
  std::optional<Wanted> wanted;
  while (take_work(tasks, wanted)) {
    if (wanted) {
      std::visit([this](const auto& message) { bench_.set_wanted(message); }, wanted->message);
      unanswered_ = wanted->arrived;
    }
    // Targets before a command are processed before it: the last one counts on release.
    if (!tasks.empty() && unanswered_) make_step(Clock::now());
    for (const Task& task : tasks) task(bench_);
    tasks.clear();
    publish_state();
    if (const Clock::time_point now = Clock::now(); now >= next_step_) make_step(now);
    publish_state();  // what ended by itself
    if (!bench_.wants_step()) unanswered_.reset();
  }
}

}  // namespace dismantle::server
