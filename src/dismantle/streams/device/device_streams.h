// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/bvtt_front.h"
#include "dismantle/streams/device/device_buffers.h"
#include "dismantle/streams/matrix_stream.h"
#include "dismantle/streams/streams_backend.h"

#include <algorithm>
#include <utility>

namespace dismantle {

/// All streams of method `streams` in a device's memory (Du et al. 2015, figure 3): only S_tm is uploaded and only
/// contacts are downloaded. A step replays one recording of launches and waits once; it is run again if an array was
/// full, and continued if the front needs more rounds, or S_t more room, than are recorded.
///
/// @tparam Queue the device: HostQueue or CudaQueue
template <class Queue>
class DeviceStreams {
 public:
  /// @param fixed need not outlive this
  /// @param bounds of all nodes in the assembled state
  DeviceStreams(Queue queue, const AssemblyTriangles& fixed, Span<const Kdop16> bounds,
                const CollisionOptions& options);

  /// Sets the ghost surfaces. To be called once, before the first step.
  /// @param bounds of all nodes in the assembled state, with the ghosts' margins
  void set_ghosts(const GhostVertices& ghosts, Span<const Kdop16> bounds);
  ///@{ See StreamsBackend.
  void set_rules(PairRulesView rules);
  StreamsStep step(Span<const RigidTransform> next);
  void commit();
  void jump(Span<const RigidTransform> state);
  Span<const RigidTransform> state() const { return matrices_.start(); }
  std::vector<std::uint64_t> triangle_pairs();
  ///@}

 private:
  enum Mark { kBegin, kVertices, kRefit, kFront, kEnd };

  const device_code::StepCounters& counters() const { return report_.on_host()[0].counters; }
  device_code::StepCounters* shared_counters() { return &report_.on_device().data()->counters; }
  FrontSproutKernel front_kernel(Span<const std::uint64_t> items);
  device_code::FrontSink front_sink(int round);

  void set_vertices_input(Span<const RigidTransform> next);
  void set_step_input(Span<const RigidTransform> next);
  void enqueue_vertices();
  void enqueue_bounds();
  void enqueue_rounds();
  void enqueue_front_end();
  void enqueue_narrow_phase();
  void enqueue_narrow_round(std::size_t count, const NarrowPhaseKernel& kernel, const device_code::NarrowSink& sink,
                            std::size_t begin);
  void run_step();
  bool finish_front();
  void forget_recordings();
  void watch_front_size();
  StreamsStep result();

  Queue queue_;
  ElementaryTest test_;
  MatrixStream matrices_;
  device_code::Geometry geometry_;
  DeviceArray<Vec3> vertices_[2];  // S_v(n) is at start_
  DeviceArray<Kdop16> bounds_;     // S_bv, S_bvh
  DeviceArray<std::uint32_t> arrivals_;
  DeviceArray<Vec3> displaced_;  // of the ghosts
  DeviceArray<float> margins_;   // of the leaves
  DeviceArray<PairRuleEntry> rules_;
  bool has_discrete_rules_ = false;
  device_code::Upload upload_;
  MirroredArray<device_code::StepReport> report_;
  device_code::Buffers buffers_;

  std::size_t start_ = 0;
  typename Queue::Recording recording_[2];    // of a step, for each index of S_v(n)
  std::vector<std::uint32_t> front_classes_;  // for which the front was built
  bool restart_front_ = true;
  std::size_t fresh_size_ = 0;  // of the front after the last restart
  std::size_t excess_ = 0;      // visits beyond that since then, summed over the steps
  std::size_t replays_ = 0;     // of the last step
  device_code::PairRoom pair_room_;
};

template <class Queue>
DeviceStreams<Queue>::DeviceStreams(Queue queue, const AssemblyTriangles& fixed, Span<const Kdop16> bounds,
                                    const CollisionOptions& options)
    : queue_(std::move(queue)),
      test_(options.test),
      matrices_(fixed.component_count()),
      geometry_(queue_, fixed),
      vertices_{DeviceArray<Vec3>(queue_, Span<const Vec3>(fixed.vertices)),
                DeviceArray<Vec3>(queue_, Span<const Vec3>(fixed.vertices))},
      bounds_(queue_, bounds),
      arrivals_(queue_, Span<const std::uint32_t>(std::vector<std::uint32_t>(fixed.bvh.children.size(), 0))),
      upload_(queue_, fixed.component_count()),
      report_(queue_, 1),
      buffers_(queue_, std::max<std::size_t>(options.initial_capacity, 1)),
      pair_room_(buffers_.triangle_pairs.size()) {
  report_.on_host()[0] = {};
  report_.copy_up(queue_);
  queue_.wait();
}

template <class Queue>
void DeviceStreams<Queue>::set_ghosts(const GhostVertices& ghosts, Span<const Kdop16> bounds) {
  displaced_ = DeviceArray<Vec3>(queue_, Span<const Vec3>(ghosts.displaced));
  margins_ = DeviceArray<float>(queue_, Span<const float>(ghosts.margins));
  bounds_ = DeviceArray<Kdop16>(queue_, bounds);
  forget_recordings();
}

template <class Queue>
void DeviceStreams<Queue>::set_rules(PairRulesView rules) {
  rules_ = DeviceArray<PairRuleEntry>(queue_, rules.table);
  has_discrete_rules_ = std::any_of(rules.table.begin(), rules.table.end(), [](const PairRuleEntry& entry) {
    return entry.a != PairRuleEntry::kFree && entry.rule.test == PairTest::Discrete;
  });
  forget_recordings();
}

template <class Queue>
std::vector<std::uint64_t> DeviceStreams<Queue>::triangle_pairs() {
  const std::size_t count = counters().triangle_pairs;
  if (!pair_room_.one_round()) return brought_down(queue_, buffers_.sorted_pairs, count);
  std::vector<std::uint64_t> pairs = brought_down(queue_, buffers_.triangle_pairs, count);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <class Queue>
void DeviceStreams<Queue>::forget_recordings() {
  for (typename Queue::Recording& recording : recording_) recording.forget();
}

template <class Queue>
void DeviceStreams<Queue>::commit() {
  matrices_.commit();
  start_ = 1 - start_;
}

template <class Queue>
void DeviceStreams<Queue>::jump(Span<const RigidTransform> state) {
  // As a candidate that is committed: only vertices of the candidate can be computed. The next step updates the bounds.
  set_vertices_input(state);
  upload_.on_host().input() = {};
  enqueue_vertices();
  queue_.wait();
  commit();
}

template <class Queue>
StreamsStep DeviceStreams<Queue>::step(Span<const RigidTransform> next) {
  set_step_input(next);
  run_step();
  watch_front_size();
  if (pair_room_.shrink(counters().triangle_pairs)) forget_recordings();
  return result();
}

template <class Queue>
void DeviceStreams<Queue>::set_vertices_input(Span<const RigidTransform> next) {
  const device_code::UploadView upload = upload_.on_host();
  const Span<device_code::ComponentStep> components = upload.components();
  std::fill(components.begin(), components.end(), device_code::ComponentStep{});
  std::copy(state().begin(), state().end(), upload.start().begin());
  std::copy(next.begin(), next.end(), upload.end().begin());
  for (const ComponentId c : matrices_.set_next(next)) components[c.value].make_vertices = 1;
  const Span<const std::uint32_t> classes = matrices_.motion_class();
  std::copy(classes.begin(), classes.end(), upload.motion_class().begin());
}

template <class Queue>
void DeviceStreams<Queue>::set_step_input(Span<const RigidTransform> next) {
  set_vertices_input(next);
  for (const ComponentId c : matrices_.take_outdated_bounds()) upload_.on_host().components()[c.value].fit_bounds = 1;
  const Span<const std::uint32_t> classes = matrices_.motion_class();
  const bool same_classes =
      front_classes_.size() == classes.size() && std::equal(classes.begin(), classes.end(), front_classes_.begin());
  if (!same_classes) {
    front_classes_.assign(classes.begin(), classes.end());
    restart_front_ = true;
  }
  upload_.on_host().input() = {restart_front_ ? 1u : 0u};
}

template <class Queue>
void DeviceStreams<Queue>::run_step() {
  replays_ = 0;
  do {
    queue_.replay(recording_[start_], [this] {
      queue_.mark(kBegin);
      enqueue_vertices();
      queue_.mark(kVertices);
      enqueue_bounds();
      queue_.mark(kRefit);
      queue_.launch_counted(
          buffers_.front.size(), &shared_counters()->front,
          device_code::SproutFront{front_kernel(buffers_.front.view()), front_sink(0), shared_counters()});
      enqueue_rounds();
      enqueue_front_end();
      queue_.mark(kFront);
      enqueue_narrow_phase();
      queue_.mark(kEnd);
    });
    queue_.wait();
  } while (!finish_front());
  while (pair_room_.grow(counters().triangle_pairs, buffers_.triangle_pairs.size())) {
    ++replays_;
    forget_recordings();
    enqueue_narrow_phase();
    queue_.wait();
  }
  while (buffers_.grow_narrow_phase(queue_, counters())) {
    ++replays_;
    forget_recordings();
    enqueue_narrow_phase();
    queue_.wait();
  }
}

/// Runs the remaining rounds of the front. False if an array was full: then the step must be run again.
template <class Queue>
bool DeviceStreams<Queue>::finish_front() {
  while (counters().complete == 0) {
    if (buffers_.grow_front(queue_, counters())) {
      ++replays_;
      forget_recordings();
      return false;
    }
    queue_.launch(1, device_code::CarryPending{shared_counters()});
    enqueue_rounds();
    enqueue_front_end();
    queue_.mark(kFront);
    enqueue_narrow_phase();
    queue_.mark(kEnd);
    queue_.wait();
  }
  return true;
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_vertices() {
  upload_.copy_up(queue_);
  const device_code::UploadView upload = upload_.on_device();
  queue_.launch(
      std::max<std::size_t>(geometry_.assembled.size(), 1),
      device_code::MoveVertices{{shared_counters(), &upload.input(), buffers_.front.view(), geometry_.first_front_node},
                                upload.components(),
                                upload.end(),
                                geometry_.component_of_vertex.view(),
                                geometry_.assembled.view(),
                                vertices_[1 - start_].view()});
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_bounds() {
  const BvhRefitLeafKernel leaf_kernel{
      vertices_[start_].view(), vertices_[1 - start_].view(), geometry_.faces.view(), bounds_.view(), 0,
      margins_.view()};
  queue_.launch(geometry_.leaf_count, device_code::FitBounds{leaf_kernel,
                                                             {geometry_.tree(), bounds_.view()},
                                                             upload_.on_device().components(),
                                                             geometry_.ranges.view(),
                                                             geometry_.parents.view(),
                                                             arrivals_.view()});
}

template <class Queue>
FrontSproutKernel DeviceStreams<Queue>::front_kernel(Span<const std::uint64_t> items) {
  return {geometry_.tree(), bounds_.view(), upload_.on_device().motion_class(), items, kDeviceFrontWorkBudget};
}

/// The sink of the round that appends to pending[round].
template <class Queue>
device_code::FrontSink DeviceStreams<Queue>::front_sink(int round) {
  device_code::StepCounters* counters = shared_counters();
  return {{buffers_.triangle_pairs.view(), &counters->triangle_pairs},
          {buffers_.kept.view(), &counters->kept},
          {buffers_.sprouted.view(), &counters->sprouted},
          {buffers_.pending[round % 2].view(), &counters->pending[round]}};
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_rounds() {
  static_assert(device_code::kFrontRounds % 2 == 0,
                "the last round leaves its pairs in the array that the first one reads");
  for (int round = 1; round <= device_code::kFrontRounds; ++round) {
    const Span<const std::uint64_t> left = std::as_const(buffers_.pending[(round - 1) % 2]).view();
    const std::uint64_t* count = &shared_counters()->pending[round - 1];
    queue_.launch_counted(left.size(), count, device_code::ResumeFront{front_kernel(left), front_sink(round), count});
  }
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_front_end() {
  device_code::StepCounters* counters = shared_counters();
  queue_.launch(1, device_code::CompleteFront{counters, buffers_.capacity()});
  queue_.launch(
      std::max(buffers_.kept.size(), buffers_.sprouted.size()),
      device_code::ReplaceSprouted{counters, buffers_.kept.view(), buffers_.sprouted.view(), buffers_.front.view()});
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_narrow_phase() {
  device_code::StepCounters* counters = shared_counters();
  const std::size_t max_pairs = pair_room_.size();
  const Span<std::uint64_t> pairs = buffers_.triangle_pairs.view().subspan(0, max_pairs);
  const Span<std::uint64_t> sorted = buffers_.sorted_pairs.view().subspan(0, max_pairs);
  queue_.launch(max_pairs, device_code::BeginNarrowPhase{counters, pairs});
  if (!pair_room_.one_round()) queue_.sort(pairs, sorted, geometry_.key_bits, buffers_.sort_scratch.view());
  NarrowPhaseKernel kernel{pair_room_.one_round() ? pairs : sorted,
                           {vertices_[start_].view(), vertices_[1 - start_].view(), geometry_.faces.view()},
                           {displaced_.view(), margins_.view(), upload_.on_device().start(), upload_.on_device().end()},
                           bounds_.view(),
                           geometry_.component_of_node.view(),
                           geometry_.features.view(),
                           {rules_.view()},
                           test_};
  device_code::NarrowSink sink{{buffers_.contacts.view(), &counters->contacts},
                               {buffers_.intersections.view(), &counters->intersections},
                               counters,
                               0};
  for (std::size_t begin = 0; begin < max_pairs; begin = narrow_phase_round_end(begin), ++sink.round)
    enqueue_narrow_round(std::min(narrow_phase_round_end(begin), max_pairs) - begin, kernel, sink, begin);
  queue_.launch(buffers_.contacts.size(),
                device_code::ReportFirstContacts{
                    counters,
                    buffers_.contacts.view(),
                    {{report_.on_device().data()->contacts, device_code::kReportedContacts}, &counters->reported}});
  report_.copy_down(queue_);
}

template <class Queue>
void DeviceStreams<Queue>::enqueue_narrow_round(std::size_t count, const NarrowPhaseKernel& kernel,
                                                const device_code::NarrowSink& sink, std::size_t begin) {
  queue_.launch(count, device_code::TestTrianglePairs<kCertifiedTest>{kernel, sink, begin});
  if (test_ == ElementaryTest::Elementary)
    queue_.launch(count, device_code::TestTrianglePairs<kElementaryTest>{kernel, sink, begin});
  if (has_discrete_rules_) queue_.launch(count, device_code::TestTrianglePairs<kDiscreteTest>{kernel, sink, begin});
}

/// Restarts a front that has grown too much, by the rule of Front.
template <class Queue>
void DeviceStreams<Queue>::watch_front_size() {
  const std::size_t size = counters().front;
  if (restart_front_) {
    fresh_size_ = std::max<std::size_t>(size, 1);
    excess_ = 0;
  }
  excess_ += size - std::min(size, fresh_size_);
  restart_front_ = excess_ > kFrontRestartShare * fresh_size_;
}

template <class Queue>
StreamsStep DeviceStreams<Queue>::result() {
  const device_code::StepCounters& counts = counters();
  StreamsStep step;
  if (counts.reported <= device_code::kReportedContacts) {
    const TrianglePairContact* contacts = report_.on_host()[0].contacts;
    step.contacts.assign(contacts, contacts + counts.reported);
  } else {
    step.contacts = first_of(brought_down(queue_, buffers_.contacts, counts.contacts));
  }
  step.intersecting = brought_down(queue_, buffers_.intersections, counts.intersections);
  step.timings.vertices = queue_.milliseconds(kBegin, kVertices);
  step.timings.refit = queue_.milliseconds(kVertices, kRefit);
  step.timings.front = queue_.milliseconds(kRefit, kFront);
  step.timings.intersection = queue_.milliseconds(kFront, kEnd);
  step.sizes.front = counts.front;
  step.sizes.triangle_pairs = counts.triangle_pairs;
  step.sizes.elementary_tests = counts.tests;
  step.sizes.replays = replays_;
  return step;
}

}  // namespace dismantle
