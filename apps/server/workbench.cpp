// SPDX-License-Identifier: Apache-2.0
#include "apps/server/workbench.h"

#include "dismantle/documents/path_file.h"
#include "dismantle/files/read_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dismantle::server {

namespace {

/// Lifetime of a velocity, and the maximum time over which one step integrates it [s].
constexpr double kRateLifetime = 0.15, kMaxRateStep = 0.02;
/// Distance within which contacts are reported for responses Stop and Touch, in tolerances.
constexpr double kContactReach = 2;
constexpr std::chrono::microseconds kDragInterval{1000}, kAutomaticInterval{8000};
/// Maximum time by which one step advances an automatic motion or a playback [s].
constexpr double kMaxAdvance = 0.1;
constexpr std::size_t kMaxGuideBytes = std::size_t{256} << 20;

double seconds_between(Workbench::Clock::time_point from, Workbench::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

ContactMessage contact_message(const ContactPoint& c) {
  const auto single = [](const Vec3& v) {
    return Vec3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  return {c.moving.value,  c.fixed.value,   c.face_moving.value, c.face_fixed.value, static_cast<float>(c.gap),
          single(c.point), single(c.normal)};
}

}  // namespace

Workbench::~Workbench() {
  if (model_) journals_.detach(session());
}

void Workbench::set_model(Model model) {
  if (model_) journals_.detach(session());
  model_ = std::move(model);
  search_result_.reset();
  instructions_.reset();
  drop_input();
  const Result<RestoredSession> attached = journals_.attach(session());
  is_resumed_ = attached && attached->is_restored;
  if (attached && !attached->warning.empty()) warning_ = attached->warning;
  is_resumable_ = journals_.can_resume(session());
  journal_failed_ = !attached;
  if (!attached) warning_ = attached.error().message;
  changed_ = true;
}

Result<Done> Workbench::open_guide(const std::filesystem::path& file, const std::string& name) {
  if (!model_) return Error{ErrorKind::Usage, "no path can be opened (no assembly is open); open the assembly first"};
  Result<std::string> text = read_file(file, kMaxGuideBytes);
  if (!text) return text.error();
  const Result<Path> path = parse_path(*text, name);
  if (!path) return path.error();
  changed_ = true;
  drop_input();
  return session().set_guide(name, std::move(*text), *path);
}

std::optional<std::string> Workbench::guide_text() const {
  if (!model_ || session().guide() == nullptr) return {};
  return session().guide()->text;
}

Result<Json> Workbench::search(SearchRequest request) {
  const SearchKind kind = request.kind;
  for (const ComponentId c : request.targets) {
    const std::string& name = session().assembly()[c].name;
    if (kind != SearchKind::Plan && session().is_removed(c))
      return Error{ErrorKind::Usage,
                   "nothing can be searched for '" + name + "' (it was taken out); put it back first"};
    if (std::find(request.fixed.begin(), request.fixed.end(), c) != request.fixed.end())
      return Error{ErrorKind::Usage,
                   "'" + name + "' cannot be removed (it is both target and fixed); leave out one of the two"};
  }
  if (kind == SearchKind::TakeOut) {
    if (session().playback() != nullptr)
      return Error{ErrorKind::Usage, "the path cannot be followed now (a playback is open); stop it first"};
    session().release();
    drop_input();
  }
  request.snapshot = std::make_shared<const SessionSnapshot>(kind == SearchKind::Plan ? assembled_snapshot(session())
                                                                                      : current_snapshot(session()));
  request.engine = session().options();
  const Result<std::uint32_t> job = start_search_(request);
  if (!job) return job.error();
  return Json{{"job", *job}};
}

void Workbench::apply_search_result(const SearchResult& result) {
  if (!model_ || result.snapshot->assembly.source_sha256 != model_->assembly->source_sha256) return;
  changed_ = true;
  search_result_ = result;
  if (result.kind == SearchKind::Plan && result.steps > 0) {
    const Result<Done> guided = session().set_guide("plan.path.json", path_text(result.path), result.path);
    if (!guided) warning_ = guided.error().message;
  }
  if (result.kind == SearchKind::TakeOut && result.complete) follow_removals(result);
}

void Workbench::keep_instructions(const Assembly& assembly, MadeInstructions made) {
  if (!model_ || model_->assembly.get() != &assembly) return;
  std::string notes;
  for (const std::string& note : made.notes) notes += (notes.empty() ? "" : "; ") + note;
  if (!notes.empty()) warn("The PDF: " + notes);
  instructions_ = std::move(made);
}

void Workbench::follow_removals(const SearchResult& result) {
  search_result_.reset();
  Result<Done> followed = Error{ErrorKind::Usage,
                                "a path was found but not followed (components were moved meanwhile); "
                                "search again"};
  if (session().activity() == SessionActivity::Idle && is_current(*result.snapshot, session()))
    followed = session().take_out_along(result.removals);
  if (!followed) warning_ = followed.error().message;
  drop_input();
  stepped_at_ = Clock::now();
}

void Workbench::drop_outdated_result() {
  if (!search_result_) return;
  const bool valid = search_result_->kind == SearchKind::Plan
                         ? session().guide() != nullptr || search_result_->steps == 0
                         : is_current(*search_result_->snapshot, session());
  if (!valid) search_result_.reset();
}

void Workbench::drop_input() {
  target_.reset();
  rate_.reset();
  number_ = 0;
  settled_ = true;
}

void Workbench::stop_motion() {
  if (!model_) return;
  session().pause();
  session().release();
  drop_input();
  changed_ = true;
}

Result<Json> Workbench::grab(const std::vector<ComponentId>& components) {
  const Result<Done> grabbed = session().hold(components);
  drop_input();
  if (!grabbed) return grabbed.error();
  ++grip_;
  grabbed_at_ = stepped_at_ = Clock::now();
  return Json{{"grip", grip_}};
}

void Workbench::set_input(const TargetMessage& target) {
  if (!is_dragging() || target.grip != grip_ || target.number <= number_) return;
  target_ = target;
  rate_.reset();
  number_ = target.number;
  settled_ = false;
}

void Workbench::set_input(const RateMessage& rate) {
  if (!is_dragging() || rate.grip != grip_ || rate.number <= number_) return;
  if (!rate_) stepped_at_ = Clock::now();
  rate_ = rate;
  target_.reset();
  number_ = rate.number;
  rate_at_ = Clock::now();
  settled_ = false;
}

bool Workbench::moves_automatically() const {
  if (!model_) return false;
  return session().activity() == SessionActivity::Automatic ||
         (session().playback() != nullptr && session().playback()->is_playing());
}

bool Workbench::needs_step() const {
  return moves_automatically() || (is_dragging() && !settled_ && (target_ || rate_));
}

std::chrono::microseconds Workbench::step_interval() const {
  return moves_automatically() ? kAutomaticInterval : kDragInterval;
}

Pose Workbench::target_pose(Clock::time_point now) {
  if (target_) return target_->pose;
  const double dt = std::min(seconds_between(stepped_at_, now), kMaxRateStep);
  const Pose& pose = session().poses()[session().moving()[0].value];
  const Vec3 center = session().moving_center();
  const double angle = dt * length(rate_->angular_velocity);
  const Quat turn = angle > 0 ? quat_about(normalized(rate_->angular_velocity), angle) : Quat{};
  return Pose{center + dt * rate_->velocity, turn} * Pose{-center, {}} * pose;
}

StepResult Workbench::drag(Clock::time_point now) {
  const bool by_rate = rate_.has_value();
  StepResult result = session().drag(target_pose(now), seconds_between(grabbed_at_, now));
  stepped_at_ = now;
  settled_ = result.reached || (result.poses.empty() && !result.unfinished);
  if (by_rate) settled_ = seconds_between(rate_at_, now) > kRateLifetime;
  return result;
}

StepResult Workbench::advance(Clock::time_point now) {
  const std::vector<ComponentId> before(session().moving().begin(), session().moving().end());
  const std::size_t move = session().playback() != nullptr ? session().playback()->position().move : 0;
  StepResult result = session().advance(std::min(seconds_between(stepped_at_, now), kMaxAdvance));
  stepped_at_ = now;
  const Span<const ComponentId> after = session().moving();
  changed_ |= !moves_automatically() || !std::equal(before.begin(), before.end(), after.begin(), after.end());
  changed_ |= session().playback() != nullptr && session().playback()->position().move != move;
  return result;
}

std::optional<PoseMessage> Workbench::step(Clock::time_point now) {
  if (!needs_step()) return {};
  const StepResult result = moves_automatically() ? advance(now) : drag(now);
  const Clock::time_point end = Clock::now();
  statistics_.add_step(1e6 * seconds_between(now, end), end);
  check_journal();
  PoseMessage message = pose_message(result, now);
  message.step_us = static_cast<float>(1e6 * seconds_between(now, end));
  return message;
}

void Workbench::check_journal() {
  const Journal* journal = session().journal();
  if (journal_failed_ || journal == nullptr || !journal->has_failed()) return;
  journal_failed_ = true;
  warning_ = "this session is no longer stored (its journal cannot be written: is the disk full?); save the recording";
}

PoseMessage Workbench::pose_message(const StepResult& step, Clock::time_point now) const {
  PoseMessage m;
  if (!step.unfinished) m.flags = static_cast<std::uint8_t>(step.reached ? kReached : kStopped);
  m.state = state_number_;
  m.grip = is_dragging() ? grip_ : 0;
  m.answered = number_;
  m.time = seconds_between(grabbed_at_, now);
  if (const Playback* playback = session().playback()) {
    m.flags |= kPlayback;
    m.time = playback->time();
  } else if (!is_dragging()) {
    m.flags |= kAutomatic;
  }
  m.pose = step.pose;
  m.clearance = step.clearance;
  m.contacts = contact_messages(step);
  return m;
}

std::vector<ContactMessage> Workbench::contact_messages(const StepResult& step) const {
  std::vector<ContactPoint> points = step.contact_points;
  if (points.empty() && !step.blocking_pairs.empty())
    points = session().engine().contacts(kContactReach * session().pairs().tolerance);
  std::stable_sort(points.begin(), points.end(),
                   [](const ContactPoint& a, const ContactPoint& b) { return a.gap < b.gap; });
  points.resize(std::min(points.size(), kMaxContacts));
  std::vector<ContactMessage> messages;
  messages.reserve(points.size());
  for (const ContactPoint& p : points) messages.push_back(contact_message(p));
  return messages;
}

std::optional<std::string> Workbench::recording_text() const {
  if (!model_) return {};
  return path_text(session().recording());
}

std::string Workbench::recording_name() const {
  const std::string stem = model_ ? std::filesystem::path(model_->assembly->source_file).stem().string() : "";
  return (stem.empty() ? "assembly" : stem) + ".path.json";
}

std::optional<std::string> Workbench::take_state() {
  if (!model_ || !changed_) return {};
  changed_ = false;
  drop_outdated_result();
  Json json{{"event", "state"}, {"number", ++state_number_}, {"model", model_->number}};
  json["hand"] = nullptr;
  if (is_dragging()) json["hand"] = {{"grip", grip_}, {"components", to_json(session().moving())}};
  json.update(state_json(session()));
  json["search"] = search_result_ ? search_json(*search_result_) : Json(nullptr);
  json["resumed"] = is_resumed_;
  json["resumable"] = is_resumable_ && session().done().empty();
  return text_of(json);
}

}  // namespace dismantle::server
