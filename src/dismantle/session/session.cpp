// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/session.h"

#include "dismantle/session/session_path.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Where the set stood still for longer than this [s], a frame says until when.
constexpr double kLongestRest = 0.05;
/// The time that the step after a rest is given [s]: about a frame of a screen.
constexpr double kStepTime = 1.0 / 60;

PairList pair_list(const std::vector<ComponentPair>& pairs) {
  PairList list;
  for (const ComponentPair& p : pairs) list.emplace_back(p.a, p.b);
  std::sort(list.begin(), list.end());
  return list;
}

/// The box around the assembled set.
Aabb assembled_box(const Assembly& assembly, Span<const ComponentId> components) {
  Aabb box;
  for (const ComponentId c : components) box.extend(assembled_bounds(assembly[c]));
  return box;
}

}  // namespace

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
      visibility_(assembly.components.size()) {}

std::unique_ptr<CertificateEngine> Session::make_engine(const PairList& embedded) const {
  PairStates states = pairs_;
  std::erase_if(states.pairs, [&](const ComponentPair& p) {
    return p.state == PairState::Embedded && !std::binary_search(embedded.begin(), embedded.end(), std::pair(p.a, p.b));
  });
  return std::make_unique<CertificateEngine>(*assembly_, states, options_);
}

PairList Session::embedded() const {
  return pair_list(engine_->embedded_pairs());
}

Result<Done> Session::check_set(Span<const ComponentId> components) const {
  if (components.empty())
    return Error{ErrorKind::Usage, "nothing can be taken in hand (no component is selected); select at least one"};
  for (const ComponentId c : components) {
    const std::string& name = (*assembly_)[c].name;
    if (removed_[c.value])
      return Error{ErrorKind::Usage, "'" + name + "' cannot be moved (it was taken out); put it back first"};
    if (visibility_.is_hidden(c))
      return Error{ErrorKind::Usage, "'" + name + "' cannot be moved (it is hidden); show it first"};
    if (!(poses()[c.value] == poses()[components[0].value]))
      return Error{ErrorKind::Usage, "'" + name + "' and '" + (*assembly_)[components[0]].name +
                                         "' cannot be moved as one body (they were moved apart before); move them one "
                                         "after another"};
  }
  return Done{};
}

SessionEntry Session::new_entry(std::string_view verb, Span<const ComponentId> components) const {
  SessionEntry entry;
  entry.label = std::string(verb) + " " + names_of(*assembly_, components);
  entry.components.assign(components.begin(), components.end());
  entry.frames = {{0, poses()[components[0].value]}};
  entry.embedded_before = entry.embedded_after = embedded();
  for (const ComponentId c : components) entry.removed_before.push_back(removed_[c.value]);
  return entry;
}

Result<Done> Session::hold(Span<const ComponentId> components) {
  release();
  std::vector<ComponentId> set(components.begin(), components.end());
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  if (Result<Done> sane = check_set(set); !sane) return sane;
  engine_->hold(set);
  open_ = new_entry("move", set);
  moving_center_ = assembled_box(*assembly_, set).center();
  moving_ = std::move(set);
  activity_ = SessionActivity::Drag;
  return Done{};
}

Vec3 Session::moving_center() const {
  DISMANTLE_EXPECT(!moving_.empty());
  return transform_from_pose(poses()[moving_[0].value]) * moving_center_;
}

StepResult Session::drag(const Pose& target, double time) {
  DISMANTLE_EXPECT(activity_ == SessionActivity::Drag);
  StepResult step = engine_->step(target, response_);
  std::vector<Frame>& frames = open_->frames;
  if (!step.way.empty()) {
    time = std::max(time, frames.back().time);
    if (time - frames.back().time > kLongestRest) frames.push_back({time - kStepTime, frames.back().pose});
    append_way(frames, time, step);
  }
  return step;
}

bool Session::finish_entry() {
  SessionEntry entry = std::move(*open_);
  open_.reset();
  if (!has_effect(entry)) return false;
  entry.embedded_after = embedded();
  entries_.resize(done_count_);
  entries_.push_back(std::move(entry));
  ++done_count_;
  return true;
}

void Session::be_idle() {
  open_.reset();
  moving_.clear();
  activity_ = SessionActivity::Idle;
}

bool Session::release() {
  if (activity_ != SessionActivity::Drag) return false;
  const bool moved = finish_entry();
  be_idle();
  return moved;
}

void Session::cancel_drag() {
  if (activity_ != SessionActivity::Drag) return;
  put(*open_, open_->frames.front(), open_->embedded_before);
  be_idle();
}

void Session::put(const SessionEntry& entry, const Frame& frame, const PairList& wanted) {
  std::vector<Pose> all(poses().begin(), poses().end());
  for (const ComponentId c : entry.components) all[c.value] = frame.pose;
  if (embedded() != wanted) engine_ = make_engine(wanted);
  engine_->jump(all);
}

Result<Done> Session::undo() {
  if (activity_ == SessionActivity::Drag && !release()) return Done{};  // back where it never left
  if (done_count_ == 0) return Error{ErrorKind::Usage, "nothing can be undone (nothing was done yet)"};
  const SessionEntry& entry = entries_[--done_count_];
  put(entry, entry.frames.front(), entry.embedded_before);
  for (std::size_t i = 0; i < entry.components.size(); ++i)
    removed_[entry.components[i].value] = entry.removed_before[i];
  return Done{};
}

Result<Done> Session::redo() {
  release();
  if (done_count_ == entries_.size()) return Error{ErrorKind::Usage, "nothing can be redone (nothing was undone)"};
  const SessionEntry& entry = entries_[done_count_++];
  put(entry, entry.frames.back(), entry.embedded_after);
  if (entry.removed_after)
    for (const ComponentId c : entry.components) removed_[c.value] = *entry.removed_after;
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

  const std::vector<std::string> outside = removed_components(*assembly_, poses());
  for (std::size_t c = 0; c < removed_.size(); ++c) {
    const std::string& name = assembly_->components[c].name;
    if (removed_[c] || std::find(outside.begin(), outside.end(), name) != outside.end()) path.removed.push_back(name);
  }
  return path;
}

void Session::reset() {
  engine_ = std::make_unique<CertificateEngine>(*assembly_, pairs_, options_);
  entries_.clear();
  done_count_ = 0;
  removed_.assign(removed_.size(), false);
  visibility_ = Visibility(removed_.size());
  be_idle();
}

}  // namespace dismantle
