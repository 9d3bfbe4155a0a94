// SPDX-License-Identifier: Apache-2.0
#include "apps/server/workbench.h"

#include "dismantle/io/path_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dismantle::server {

namespace {

/// How long a rate holds that is not renewed, and the longest time that one step integrates it over [s].
constexpr double kRateLife = 0.15, kLongestRateStep = 0.02;
/// Of stop and touch, which give no contact points: how far to look for them, in tolerances.
constexpr double kContactReach = 2;

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

void Workbench::adopt(Model model) {
  model_ = std::move(model);
  drop_targets();
  changed_ = true;
}

void Workbench::drop_targets() {
  target_.reset();
  rate_.reset();
  number_ = 0;
  settled_ = true;
}

void Workbench::let_go() {
  if (!is_dragging()) return;
  session().release();
  drop_targets();
  changed_ = true;
}

Result<Json> Workbench::hold(const std::vector<ComponentId>& components) {
  const Result<Done> held = session().hold(components);
  drop_targets();
  if (!held) return held.error();
  ++grip_;
  held_at_ = stepped_at_ = Clock::now();
  return Json{{"grip", grip_}};
}

void Workbench::set_wanted(const TargetMessage& target) {
  if (!is_dragging() || target.grip != grip_ || target.number <= number_) return;
  target_ = target;
  rate_.reset();
  number_ = target.number;
  settled_ = false;
}

void Workbench::set_wanted(const RateMessage& rate) {
  if (!is_dragging() || rate.grip != grip_ || rate.number <= number_) return;
  if (!rate_) stepped_at_ = Clock::now();
  rate_ = rate;
  target_.reset();
  number_ = rate.number;
  rate_at_ = Clock::now();
  settled_ = false;
}

bool Workbench::wants_step() const {
  return is_dragging() && !settled_ && (target_ || rate_);
}

Pose Workbench::wanted_pose(Clock::time_point now) {
  if (target_) return target_->pose;
  const double dt = std::min(seconds_between(stepped_at_, now), kLongestRateStep);
  const Pose& pose = session().poses()[session().moving()[0].value];
  const Vec3 center = session().moving_center();
  const double angle = dt * length(rate_->angular_velocity);
  const Quat turn = angle > 0 ? quat_about(normalized(rate_->angular_velocity), angle) : Quat{};
  return Pose{center + dt * rate_->velocity, turn} * Pose{-center, {}} * pose;
}

std::optional<PoseMessage> Workbench::step(Clock::time_point now) {
  if (!wants_step()) return {};
  const bool by_rate = rate_.has_value();
  const Pose wanted = wanted_pose(now);
  const StepResult result = session().drag(wanted, seconds_between(held_at_, now));
  const Clock::time_point end = Clock::now();
  statistics_.add_step(1e6 * seconds_between(now, end), end);
  stepped_at_ = now;
  settled_ = result.reached || result.way.empty();
  if (by_rate) settled_ = seconds_between(rate_at_, now) > kRateLife;
  return pose_message(result, now);
}

PoseMessage Workbench::pose_message(const StepResult& step, Clock::time_point now) const {
  PoseMessage m;
  m.flags = static_cast<std::uint8_t>(step.reached ? kReached : kStopped);
  m.state = state_number_;
  m.grip = grip_;
  m.answered = number_;
  m.time = seconds_between(held_at_, now);
  m.pose = step.pose;
  m.clearance = step.clearance;
  m.step_us = static_cast<float>(1e3 * step.timings.overall);
  m.contacts = contact_messages(step);
  return m;
}

std::vector<ContactMessage> Workbench::contact_messages(const StepResult& step) const {
  std::vector<ContactPoint> points = step.touching;
  if (points.empty() && !step.contacts.empty())
    points = session().engine().contacts(kContactReach * session().pairs().tolerance);
  std::stable_sort(points.begin(), points.end(),
                   [](const ContactPoint& a, const ContactPoint& b) { return a.gap < b.gap; });
  points.resize(std::min(points.size(), kMostContacts));
  std::vector<ContactMessage> messages;
  for (const ContactPoint& p : points) messages.push_back(contact_message(p));
  return messages;
}

std::optional<std::string> Workbench::recording_text() const {
  if (!model_) return {};
  return path_text(session().recording());
}

std::string Workbench::recording_name() const {
  std::string stem = model_ ? std::filesystem::path(model_->assembly->source_file).stem().string() : "";
  std::erase_if(stem, [](unsigned char c) { return c < 0x20 || c >= 0x7f || c == '"' || c == '\\' || c == '/'; });
  return (stem.empty() ? "assembly" : stem) + ".path.json";
}

std::optional<std::string> Workbench::take_state() {
  if (!model_ || !changed_) return {};
  changed_ = false;
  Json json{{"event", "state"}, {"number", ++state_number_}, {"model", model_->number}};
  json["hand"] = nullptr;
  if (is_dragging()) json["hand"] = {{"grip", grip_}, {"components", to_json(session().moving())}};
  json.update(state_json(session()));
  return text_of(json);
}

}  // namespace dismantle::server
