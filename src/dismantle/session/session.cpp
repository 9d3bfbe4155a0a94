// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/session.h"

#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

/// A rest longer than this [s] gets a frame at its end.
constexpr double kLongestRest = 0.05;
/// Duration of the first step after a rest [s]: about one screen frame.
constexpr double kStepTime = 1.0 / 60;

/// The bounding box of the assembled set.
Aabb assembled_box(const Assembly& assembly, Span<const ComponentId> components) {
  Aabb box;
  for (const ComponentId c : components) box.extend(assembled_bounds(assembly[c]));
  return box;
}

}  // namespace

std::vector<ComponentId> sorted_set(Span<const ComponentId> components) {
  std::vector<ComponentId> set(components.begin(), components.end());
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  return set;
}

std::string names_of(const Assembly& assembly, Span<const ComponentId> components) {
  DISMANTLE_EXPECT(!components.empty());
  std::string text = assembly[components[0]].name;
  if (components.size() == 2) return text + " and " + assembly[components[1]].name;
  if (components.size() > 2) text += " and " + std::to_string(components.size() - 1) + " more";
  return text;
}

Session::Session(const Assembly& assembly, PairStates pairs, const CertificateOptions& options)
    : assembly_(&assembly),
      pairs_(std::move(pairs)),
      options_(options),
      engine_(std::make_unique<CertificateEngine>(assembly, pairs_, options)),
      removed_(assembly.components.size(), false),
      visibility_(assembly.components.size()) {
  pairs_.raise_allowances(engine_->overlapping_pairs());
}

Result<Done> Session::check_no_playback() const {
  if (activity_ != SessionActivity::Playback) return Done{};
  return Error{ErrorKind::Usage, "nothing can be changed now (a playback is open); stop it first"};
}

Result<Done> Session::check_one_pose(Span<const ComponentId> components) const {
  if (Result<Done> free = check_no_playback(); !free) return free;
  if (components.empty())
    return Error{ErrorKind::Usage, "nothing can be moved (no component is selected); select at least one"};
  for (const ComponentId c : components) {
    if (poses()[c.value] == poses()[components[0].value]) continue;
    return Error{ErrorKind::Usage, "'" + (*assembly_)[c].name + "' and '" + (*assembly_)[components[0]].name +
                                       "' cannot be moved as one body (they were moved apart before); move them one "
                                       "after another"};
  }
  return Done{};
}

Result<Done> Session::check_set(Span<const ComponentId> components) const {
  for (const ComponentId c : components) {
    const std::string& name = (*assembly_)[c].name;
    if (removed_[c.value])
      return Error{ErrorKind::Usage, "'" + name + "' cannot be moved (it was taken out); put it back first"};
    if (visibility_.is_hidden(c))
      return Error{ErrorKind::Usage, "'" + name + "' cannot be moved (it is hidden); show it first"};
  }
  return check_one_pose(components);
}

SessionEntry Session::new_entry(std::string_view verb, Span<const ComponentId> components) const {
  SessionEntry entry;
  entry.label = std::string(verb) + " " + names_of(*assembly_, components);
  entry.components.assign(components.begin(), components.end());
  entry.frames = {{0, poses()[components[0].value]}};
  for (const ComponentId c : components) entry.removed_before.push_back(removed_[c.value]);
  return entry;
}

Result<Done> Session::hold(Span<const ComponentId> components) {
  release();
  std::vector<ComponentId> set = sorted_set(components);
  if (Result<Done> sane = check_set(set); !sane) return sane;
  begin(SessionActivity::Drag, "move", std::move(set));
  return Done{};
}

void Session::begin(SessionActivity activity, std::string_view verb, std::vector<ComponentId> set) {
  engine_->grab(set);
  open_ = new_entry(verb, set);
  if (journal_) journal_->begin(*open_);
  moving_center_ = assembled_box(*assembly_, set).center();
  moving_ = std::move(set);
  activity_ = activity;
}

Vec3 Session::moving_center() const {
  DISMANTLE_EXPECT(!moving_.empty());
  return transform_from_pose(poses()[moving_[0].value]) * moving_center_;
}

void Session::set_drag_engine(DragEngine engine) {
  DISMANTLE_EXPECT(activity_ != SessionActivity::Drag);
  drag_engine_ = std::move(engine);
  if (!can_respond(response_)) response_ = ResponseKind::Touch;
}

StepResult Session::step_of_drag(const Pose& target) {
  MotionEngine* const other = drag_engine_.engine.get();
  if (other == nullptr) return engine_->step(target, response_);
  if (!std::equal(poses().begin(), poses().end(), other->poses().begin())) other->jump(poses());
  const Span<const ComponentId> held = other->moving_set();
  if (!std::equal(held.begin(), held.end(), moving_.begin(), moving_.end())) other->grab(moving_);
  StepResult step = other->step(target, response_);
  if (step.poses.empty()) return step;
  engine_->jump(other->poses());  // which releases the set
  engine_->grab(moving_);
  return step;
}

StepResult Session::drag(const Pose& target, double time) {
  DISMANTLE_EXPECT(activity_ == SessionActivity::Drag);
  StepResult step = step_of_drag(target);
  std::vector<Frame>& frames = open_->frames;
  if (step.poses.empty()) return step;
  const std::size_t before = frames.size();
  time = std::max(time, frames.back().time);
  if (time - frames.back().time > kLongestRest) frames.push_back({time - kStepTime, frames.back().pose});
  append_step_frames(frames, time, step);
  write_frames(before);
  return step;
}

void Session::write_frames(std::size_t from) {
  const std::vector<Frame>& frames = open_->frames;
  if (journal_ && frames.size() > from) journal_->add_frames({frames.data() + from, frames.size() - from});
}

bool Session::finish_entry() {
  SessionEntry entry = std::move(*open_);
  open_.reset();
  if (!has_effect(entry)) {
    if (journal_) journal_->drop();
    return false;
  }
  if (journal_) journal_->end(entry);
  entries_.resize(done_count_);
  entries_.push_back(std::move(entry));
  ++done_count_;
  return true;
}

void Session::be_idle() {
  open_.reset();
  moving_.clear();
  automatic_.reset();
  activity_ = SessionActivity::Idle;
}

bool Session::release() {
  halt();
  if (activity_ != SessionActivity::Drag) return false;
  const bool moved = finish_entry();
  be_idle();
  return moved;
}

void Session::cancel_drag() {
  if (activity_ != SessionActivity::Drag) return;
  put(*open_, open_->frames.front());
  if (journal_) journal_->drop();
  be_idle();
}

void Session::put(const SessionEntry& entry, const Frame& frame) {
  std::vector<Pose> all(poses().begin(), poses().end());
  for (const ComponentId c : entry.components) all[c.value] = frame.pose;
  engine_->jump(all);
}

Result<Done> Session::undo() {
  if (Result<Done> free = check_no_playback(); !free) return free;
  if (activity_ != SessionActivity::Idle) {
    const std::size_t before = done_count_;
    release();
    if (done_count_ == before) return Done{};  // nothing had moved
  }
  if (done_count_ == 0) return Error{ErrorKind::Usage, "nothing can be undone (nothing was done yet)"};
  const SessionEntry& entry = entries_[--done_count_];
  put(entry, entry.frames.front());
  for (std::size_t i = 0; i < entry.components.size(); ++i)
    removed_[entry.components[i].value] = entry.removed_before[i];
  if (journal_) journal_->undo();
  return Done{};
}

Result<Done> Session::redo() {
  if (Result<Done> free = check_no_playback(); !free) return free;
  release();
  if (done_count_ == entries_.size()) return Error{ErrorKind::Usage, "nothing can be redone (nothing was undone)"};
  const SessionEntry& entry = entries_[done_count_++];
  put(entry, entry.frames.back());
  if (entry.removed_after)
    for (const ComponentId c : entry.components) removed_[c.value] = *entry.removed_after;
  if (journal_) journal_->redo();
  return Done{};
}

Path Session::recording() const {
  Path path = empty_path(*assembly_, pairs_);
  const auto add = [&](const SessionEntry& entry) {
    if (!has_moved(entry)) return;
    Move move{entry.label, {}, entry.frames};
    for (const ComponentId c : entry.components) move.components.push_back((*assembly_)[c].name);
    path.moves.push_back(std::move(move));
  };
  for (const SessionEntry& entry : done()) add(entry);
  if (open_) add(*open_);

  const Span<const Pose> now = playback_ ? Span<const Pose>(live_poses_) : poses();
  const std::vector<std::string> outside = removed_components(*assembly_, now);
  for (std::size_t c = 0; c < removed_.size(); ++c) {
    const std::string& name = assembly_->components[c].name;
    if (removed_[c] || std::find(outside.begin(), outside.end(), name) != outside.end()) path.removed.push_back(name);
  }
  return path;
}

void Session::reset() {
  stop_playback();
  engine_->jump(std::vector<Pose>(poses().size()));
  entries_.clear();
  done_count_ = 0;
  removed_.assign(removed_.size(), false);
  visibility_ = Visibility(removed_.size());
  removals_.clear();
  be_idle();
  if (journal_) journal_->reset();
}

JournalHeader Session::journal_header() const {
  return {assembly_->source_file, assembly_->source_sha256, static_cast<std::uint32_t>(assembly_->components.size()),
          pairs_.tolerance};
}

void Session::close_journal() {
  if (journal_) journal_->close();
  journal_.reset();
}

RestorableState Session::restore(JournalContents contents) {
  DISMANTLE_EXPECT(entries_.empty() && contents.header == journal_header());
  PairStates allowed = pairs_;
  allowed.raise_allowances(engine_->overlapping_pairs());
  const RestorableState state = last_valid_state(*assembly_, allowed, contents);
  if (state.too_deep) contents.entries.resize(state.done_count);
  contents.done_count = state.done_count;
  entries_ = std::move(contents.entries);
  done_count_ = contents.done_count;
  std::vector<Pose> all(poses().size());
  for (const SessionEntry& entry : done()) {
    for (const ComponentId c : entry.components) {
      all[c.value] = entry.frames.back().pose;
      if (entry.removed_after) removed_[c.value] = *entry.removed_after;
    }
  }
  engine_->jump(all);
  return state;
}

void Session::rewrite_journal() {
  if (journal_) journal_->replace(entries_, done_count_);
}

}  // namespace dismantle
