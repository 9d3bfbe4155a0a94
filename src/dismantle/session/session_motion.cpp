// SPDX-License-Identifier: Apache-2.0
// Automatic motions of a session: taking out, putting back, playing.
#include "dismantle/session/session.h"

#include "dismantle/math/screw.h"
#include "dismantle/session/session_path.h"
#include "dismantle/session/step_limit.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace dismantle {

namespace {

using Clock = std::chrono::steady_clock;

/// Duration of moving out, from there to the parking position, and back home [s].
constexpr double kOutTime = 0.8, kParkTime = 0.2, kHomeTime = 1.2;
/// Targets per second.
constexpr double kTargetRate = 60;
/// Gap between parked sets, as a share of the assembly's diagonal.
constexpr double kParkGap = 0.02;
/// An automatic motion ends after this many consecutive targets that were not reached.
constexpr int kMaxStuck = 6;
/// Contacts nearer than this contribute their normals as candidate directions [tolerances].
constexpr double kContactReach = 3;
/// One advance of an automatic motion returns after about this long.
constexpr std::chrono::milliseconds kMaxTime{8};

/// Appends targets along a straight line with smooth start and end.
void append_line(std::vector<Frame>& targets, const Vec3& by, double duration) {
  const Frame from = targets.back();
  const int count = std::max(1, static_cast<int>(std::lround(duration * kTargetRate)));
  for (int i = 1; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    targets.push_back(
        {from.time + s * duration, {from.pose.position + (s * s * (3 - 2 * s)) * by, from.pose.rotation}});
  }
}

/// True if two boxes can meet when one moves straight along a direction: their projections along it overlap.
bool are_in_line(const Aabb& a, const Aabb& b, const Vec3& direction) {
  const Vec3 between = b.center() - a.center(), half = 0.5 * (a.size() + b.size());
  for (const Vec3& edge : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 across = cross(direction, edge);
    const double reach = std::fabs(across.x) * half.x + std::fabs(across.y) * half.y + std::fabs(across.z) * half.z;
    if (std::fabs(dot(across, between)) > reach) return false;
  }
  return true;
}

/// The targets of a set along a planned path from `start`, screw by screw, at the target rate.
std::vector<Frame> targets_along(const Removal& removal, const Pose& start) {
  const Pose body = start * inverse(removal.from);  // motion since then of the body that it belongs to
  std::vector<Frame> targets{{0, start}};
  for (std::size_t k = 1; k < removal.frames.size(); ++k) {
    const Frame &a = removal.frames[k - 1], &b = removal.frames[k];
    const int count = std::max(1, static_cast<int>(std::lround((b.time - a.time) * kTargetRate)));
    for (int i = 1; i <= count; ++i) {
      const double s = static_cast<double>(i) / count;
      targets.push_back({a.time + s * (b.time - a.time), body * pose_between(a.pose, b.pose, s) * removal.from});
    }
  }
  return targets;
}

/// Length of the motion from one pose to the next, with rotations counted at `characteristic_length` [mm].
double effort(const Pose& a, const Pose& b, double characteristic_length) {
  const Screw screw = screw_between(a, b);
  return length(b.position - a.position) + characteristic_length * screw.angle;
}

}  // namespace

Result<std::vector<FreeDirection>> Session::free_directions(Span<const ComponentId> components) {
  const std::vector<ComponentId> set = sorted_set(components);
  if (Result<Done> sane = check_one_pose(set); !sane) return sane.error();
  if (activity_ != SessionActivity::Idle && moving_ != set)
    return Error{ErrorKind::Usage,
                 "free directions cannot be told now (another component is moving); let go of it first"};
  if (activity_ == SessionActivity::Idle) engine_->grab(set);
  return ExitSearch(*assembly_, *engine_, set).find(kContactReach * pairs_.tolerance);
}

double Session::parking_distance(const Vec3& direction) const {
  // Sets that are taken out later park nearer: each has its own section of the exit. Sets that move beside it in the
  // same direction do not need one.
  const double gap = kParkGap * diagonal(assembled_bounds(*assembly_));
  Aabb own;
  for (const ComponentId c : moving_) own.extend(bounds_at((*assembly_)[c], poses()[c.value]));
  double sum = 0;
  for (std::uint32_t i = 0; i < removed_.size(); ++i) {
    if (removed_[i] || std::binary_search(moving_.begin(), moving_.end(), ComponentId(i))) continue;
    const Aabb box = bounds_at(assembly_->components[i], poses()[i]);
    if (!are_in_line(own, box, direction)) continue;
    const Vec3 size = box.size();
    sum += std::fabs(direction.x) * size.x + std::fabs(direction.y) * size.y + std::fabs(direction.z) * size.z + gap;
  }
  return sum;
}

Result<Done> Session::take_out(Span<const ComponentId> components, const std::optional<Vec3>& direction) {
  release();
  std::vector<ComponentId> set = sorted_set(components);
  if (Result<Done> sane = check_set(set); !sane) return sane;
  engine_->grab(set);
  const ExitSearch out(*assembly_, *engine_, set);
  std::optional<FreeDirection> way;
  if (direction || out.is_outside()) {
    const std::vector<Vec3> only{direction ? normalized(*direction) : out.outward()};
    if (!(length(only[0]) > 0))
      return Error{ErrorKind::Usage, "nothing can be taken out that way (the direction is zero); give another"};
    way = out.free_distances(only).front();
  } else if (const std::vector<FreeDirection> found = out.find(kContactReach * pairs_.tolerance); !found.empty()) {
    way = found.front();
  }
  if (!way || !way->free) {
    const std::string why =
        way && way->blocked_by.valid()
            ? "'" + (*assembly_)[way->blocked_by].name + "' is in the way); take that out first, or "
            : "it is held from all sides); take out what it touches first, or ";
    return Error{ErrorKind::Usage,
                 "'" + names_of(*assembly_, set) + "' cannot be taken out straight (" + why + "drag it out by hand"};
  }

  begin(SessionActivity::Automatic, "take out", std::move(set));
  std::vector<Frame> targets = open_->frames;
  if (way->distance > 0) append_line(targets, way->distance * way->direction, kOutTime);
  append_line(targets, parking_distance(way->direction) * way->direction, kParkTime);
  begin_automatic(AutomaticKind::TakeOut, std::move(targets));
  return Done{};
}

Result<Done> Session::take_out_along(std::vector<Removal> removals) {
  release();
  for (Removal& removal : removals) {
    removal.components = sorted_set(removal.components);
    if (Result<Done> sane = check_set(removal.components); !sane) return sane;
    DISMANTLE_EXPECT(!removal.frames.empty());
    if (!(poses()[removal.components[0].value] == removal.from))
      return Error{ErrorKind::Usage, "'" + names_of(*assembly_, removal.components) +
                                         "' cannot go the way that was found (it was moved since); search again"};
  }
  removals_.assign(std::make_move_iterator(removals.rbegin()), std::make_move_iterator(removals.rend()));
  begin_next_removal();
  return Done{};
}

void Session::begin_next_removal() {
  if (removals_.empty()) return;
  const Removal next = std::move(removals_.back());
  removals_.pop_back();
  begin(SessionActivity::Automatic, "take out", next.components);
  std::vector<Frame> targets = targets_along(next, open_->frames[0].pose);
  if (length(next.exit) > 0) append_line(targets, parking_distance(next.exit) * next.exit, kParkTime);
  begin_automatic(AutomaticKind::TakeOut, std::move(targets));
}

bool Session::moves_again(ComponentId component) const {
  return std::any_of(removals_.begin(), removals_.end(), [component](const Removal& r) {
    return std::binary_search(r.components.begin(), r.components.end(), component);
  });
}

std::vector<Frame> Session::way_back(ComponentId component) const {
  std::vector<Pose> way{poses()[component.value]};
  for (std::size_t i = done_count_; i-- > 0 && !(way.back() == Pose{});) {
    const SessionEntry& entry = entries_[i];
    if (!has_moved(entry) || !std::binary_search(entry.components.begin(), entry.components.end(), component)) continue;
    for (std::size_t k = entry.frames.size(); k-- > 0;)
      if (!(entry.frames[k].pose == way.back())) way.push_back(entry.frames[k].pose);
  }
  const double characteristic_length = diagonal(assembled_bounds((*assembly_)[component])) / 2;
  double whole = 0, made = 0;
  for (std::size_t i = 1; i < way.size(); ++i) whole += effort(way[i - 1], way[i], characteristic_length);
  std::vector<Frame> frames{{0, way[0]}};
  for (std::size_t i = 1; i < way.size(); ++i) {
    made += effort(way[i - 1], way[i], characteristic_length);
    frames.push_back({whole > 0 ? kHomeTime * made / whole : 0, way[i]});
  }
  return frames;
}

Result<Done> Session::put_back(Span<const ComponentId> components) {
  release();
  std::vector<ComponentId> set = sorted_set(components);
  if (Result<Done> sane = check_one_pose(set); !sane) return sane;
  std::vector<Frame> targets = way_back(set[0]);
  const bool is_away = std::any_of(set.begin(), set.end(), [&](ComponentId c) { return removed_[c.value]; });
  if (targets.size() < 2 && !is_away)
    return Error{ErrorKind::Usage, "'" + names_of(*assembly_, set) +
                                       "' cannot be put back (it is where it belongs); take "
                                       "it out first"};
  begin(SessionActivity::Automatic, "put back", std::move(set));
  if (is_away) open_->removed_after = false;
  for (const ComponentId c : moving_) removed_[c.value] = false;
  begin_automatic(AutomaticKind::PutBack, std::move(targets));
  return Done{};
}

void Session::begin_automatic(AutomaticKind kind, std::vector<Frame> targets) {
  Automatic begun;  // not emplace(): clang does not see a nested class's default values there
  begun.kind = kind;
  begun.targets = std::move(targets);
  begun.next = 1;
  automatic_ = std::move(begun);
}

StepResult Session::follow(const Frame& target) {
  // First the path that is known to be free; if it is no longer free, as near as the contacts allow.
  const std::size_t before = open_->frames.size();
  StepResult step = whole_step(*engine_, target.pose, ResponseKind::Stop);
  if (!step.reached) step = whole_step(*engine_, target.pose, ResponseKind::Slide);
  append_step_frames(open_->frames, std::max(target.time, open_->frames.back().time), step);
  write_frames(before);
  return step;
}

StepResult Session::advance_automatic(double dt) {
  Automatic& a = *automatic_;
  const Clock::time_point end = Clock::now() + kMaxTime;
  StepResult last;
  last.pose = poses()[moving_[0].value];
  a.clock += dt;
  while (a.next < a.targets.size() && a.targets[a.next].time <= a.clock && Clock::now() < end) {
    last = follow(a.targets[a.next++]);
    a.stuck = last.reached ? 0 : a.stuck + 1;
    if (a.stuck < kMaxStuck) continue;
    finish_automatic(false);
    return last;
  }
  if (a.next == a.targets.size()) finish_automatic(last.reached || a.stuck == 0);
  return last;
}

void Session::finish_automatic(bool reached_end) {
  const bool takes_out = automatic_->kind == AutomaticKind::TakeOut;
  const bool is_out = takes_out && (reached_end || ExitSearch(*assembly_, *engine_, moving_).is_outside());
  const bool is_done = std::none_of(moving_.begin(), moving_.end(), [this](ComponentId c) { return moves_again(c); });
  if (is_out && is_done) {
    open_->removed_after = true;
    for (const ComponentId c : moving_) removed_[c.value] = true;
  }
  finish_entry();
  be_idle();
  if (!is_out) removals_.clear();
  begin_next_removal();
}

void Session::halt() {
  removals_.clear();
  if (activity_ == SessionActivity::Automatic) finish_automatic(false);
}

StepResult Session::advance(double dt) {
  if (activity_ == SessionActivity::Automatic) return advance_automatic(dt);
  DISMANTLE_EXPECT(playback_ && playback_->is_playing());
  StepResult step = playback_->advance(*engine_, dt);
  played_removed_ = playback_->removed();
  return step;
}

Result<Done> Session::open_playback(PlaybackSource source) {
  if (playback_ && playback_->source() != source)
    return Error{ErrorKind::Usage, "this cannot be played now (another playback is open); stop that first"};
  if (playback_) return Done{};
  release();
  if (source == PlaybackSource::Guide && !guide_)
    return Error{ErrorKind::Usage, "there is no guide to play (no path file is open); open one first"};
  Timeline timeline = source == PlaybackSource::Guide ? guide_->timeline : Timeline::of_entries(done());
  if (timeline.moves().empty())
    return Error{ErrorKind::Usage, "there is nothing to play (nothing was moved yet); move something first"};
  live_poses_.assign(poses().begin(), poses().end());
  const double at = source == PlaybackSource::Guide ? 0 : timeline.duration();
  playback_.emplace(source, std::move(timeline), *assembly_, pairs_.tolerance);
  activity_ = SessionActivity::Playback;
  playback_->seek(at);
  put_playback();
  return Done{};
}

void Session::put_playback() {
  engine_->jump(playback_->poses());
  played_removed_ = playback_->removed();
}

Result<Done> Session::play(PlaybackSource source, double speed) {
  if (!std::isfinite(speed) || speed == 0)
    return Error{ErrorKind::Usage, "this cannot be played (the speed is zero or no number); give another"};
  if (Result<Done> open = open_playback(source); !open) return open;
  const Playback& p = *playback_;
  // At the end, start again from the beginning, and vice versa.
  if (speed > 0 && p.position() == p.timeline().end()) playback_->seek(0);
  if (speed < 0 && p.position() == TimelinePosition{}) playback_->seek(p.timeline().duration());
  put_playback();
  playback_->play(speed);
  return Done{};
}

Result<Done> Session::seek(PlaybackSource source, double time) {
  if (Result<Done> open = open_playback(source); !open) return open;
  playback_->pause();
  playback_->seek(time);
  put_playback();
  return Done{};
}

void Session::pause() {
  if (playback_) playback_->pause();
}

void Session::stop_playback() {
  if (!playback_) return;
  playback_.reset();
  engine_->jump(live_poses_);
  activity_ = SessionActivity::Idle;
}

Result<Done> Session::set_guide(std::string name, std::string text, const Path& path) {
  if (playback_ && playback_->source() == PlaybackSource::Guide) stop_playback();
  Result<Timeline> timeline = Timeline::of_path(*assembly_, path);
  if (!timeline) return timeline.error();
  guide_ = Guide{std::move(name), std::move(text), std::move(*timeline)};
  return Done{};
}

void Session::close_guide() {
  if (playback_ && playback_->source() == PlaybackSource::Guide) stop_playback();
  guide_.reset();
}

}  // namespace dismantle
