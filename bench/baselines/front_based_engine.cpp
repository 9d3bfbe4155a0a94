// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/front_based_engine.h"

#include "bench/baselines/front_parts.h"
#include "dismantle/streams/embedded_pairs.h"
#include "dismantle/streams/guarded_pairs.h"
#include "dismantle/streams/narrow_phase.h"
#include "dismantle/streams/stage_clock.h"
#include "dismantle/streams/vertex_kernel.h"

#include <algorithm>

namespace dismantle {

namespace {

/// The sink and results of one core over its part of the triangle pairs.
struct PairTestResults {
  std::vector<TrianglePairContact> contacts;
  std::vector<std::uint64_t> intersections;
  std::size_t tests = 0;

  void contact(const TrianglePairContact& found) { contacts.push_back(found); }
  void intersection(std::uint64_t key) { intersections.push_back(key); }
  void tested(std::size_t count) { tests += count; }
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

class FrontBasedEngine final : public SweepEngine {
 public:
  FrontBasedEngine(const Assembly& assembly, const PairStates& pairs, const CollisionOptions& options,
                   FrontBasedWork work)
      : options_(options),
        work_(work),
        fixed_(make_assembly_triangles(assembly, options.executor)),
        start_vertices_(fixed_.vertices),
        end_vertices_(fixed_.vertices),
        start_(fixed_.component_count()),
        end_(start_),
        fitted_start_(start_),
        fitted_end_(start_),
        motion_class_(fixed_.component_count(), 0),
        front_(options.executor.thread_count()),
        guards_(assembly, pairs, fixed_, options),
        embedded_(assembly, pairs),
        bounds_(bvh_fit(fixed_.bvh, fixed_.refit_plan, refit_input(), options.executor)) {}

  SweepResult sweep(Span<const RigidTransform> next, double path_deviation) override;
  void commit() override;
  void jump(Span<const RigidTransform> state) override;
  Span<const RigidTransform> state() const override { return start_; }
  std::vector<ComponentPair> overlapping_pairs() const override;

 private:
  void set_end(Span<const RigidTransform> next);
  void classify_motion();
  void refit();
  BvhRefitInput refit_input() const {
    return {start_vertices_, end_vertices_, fixed_.faces, 0, guards_.ghosts().margins};
  }
  NarrowPhaseKernel kernel() const;
  StepTriangles triangles() const { return {start_vertices_, end_vertices_, fixed_.faces}; }
  EmbeddedStep embedded_step(double path_deviation) const {
    return {&fixed_, triangles(), bounds_, start_, end_, path_deviation};
  }
  bool moves_against(std::uint64_t key) const;
  PairTestResults test_triangle_pairs();
  std::vector<std::uint64_t> embedded_triangle_pairs() const;
  void test_embedded_pairs(PairTestResults& results, double path_deviation);
  void part(const std::vector<ComponentPair>& parted);

  CollisionOptions options_;
  FrontBasedWork work_;
  AssemblyTriangles fixed_;
  std::vector<Vec3> start_vertices_, end_vertices_;
  std::vector<RigidTransform> start_, end_;
  std::vector<RigidTransform> fitted_start_, fitted_end_;  // that each component's bounds are of
  std::vector<std::uint32_t> motion_class_;  // of each component: 0 if stationary; equal if they move together
  FrontParts front_;
  GuardedPairs guards_;
  EmbeddedPairs embedded_;
  std::vector<Kdop16> bounds_;
  std::vector<ComponentPair> parting_;  // embedded pairs that part if the last sweep is committed
  bool may_commit_ = false;
};

SweepResult FrontBasedEngine::sweep(Span<const RigidTransform> next, double path_deviation) {
  DISMANTLE_EXPECT(next.size() == end_.size());
  StageClock clock;
  SweepResult result;
  parting_.clear();
  set_end(next);
  result.timings.vertices = clock.lap();
  refit();
  result.timings.refit = clock.lap();
  const Span<const std::uint32_t> may_rest =
      work_ == FrontBasedWork::MovingComponents ? motion_class_ : Span<const std::uint32_t>();
  front_.update({BvhView(fixed_.bvh), bounds_, may_rest}, options_.executor);
  result.timings.front = clock.lap();
  PairTestResults results = test_triangle_pairs();
  test_embedded_pairs(results, path_deviation);
  std::vector<BlockingPair> blocking = blocking_pairs(fixed_, results.contacts);
  append(blocking, guards_.too_deep(start_, end_));
  result.blocking_pairs = first_of(std::move(blocking));
  result.timings.intersection = clock.lap();

  for (const BlockingPair& contact : result.blocking_pairs) result.toi = std::min(result.toi, contact.toi);
  result.free = result.blocking_pairs.empty();
  result.sizes = {front_.size(), front_.triangle_pairs().size(), embedded_.pairs().size(), results.tests, 0};
  may_commit_ = result.free;
  result.timings.overall = clock.total();
  return result;
}

void FrontBasedEngine::set_end(Span<const RigidTransform> next) {
  std::vector<std::uint8_t> stays(end_.size());  // components whose vertices are already at `next`
  for (std::size_t c = 0; c < end_.size(); ++c)
    stays[c] = work_ == FrontBasedWork::MovingComponents && end_[c] == next[c];
  end_.assign(next.begin(), next.end());
  classify_motion();
  const auto cores = static_cast<std::size_t>(options_.executor.thread_count());
  options_.executor.for_each_heavy(cores, [&](std::size_t core) {
    const std::size_t begin = fixed_.vertices.size() * core / cores, end = fixed_.vertices.size() * (core + 1) / cores;
    for (std::size_t c = 0; c < end_.size(); ++c) {
      if (stays[c] != 0) continue;
      const std::size_t first = std::max<std::size_t>(begin, fixed_.vertex_begin[c]);
      const std::size_t last = std::min<std::size_t>(end, fixed_.vertex_begin[c + 1]);
      const VertexUpdateKernel kernel{end_[c], fixed_.vertices, end_vertices_};
      for (std::size_t v = first; v < last; ++v) kernel(v);
    }
  });
}

void FrontBasedEngine::classify_motion() {
  std::vector<std::size_t> first;  // the first component of each class
  for (std::size_t c = 0; c < end_.size(); ++c) {
    motion_class_[c] = 0;
    if (start_[c] == end_[c]) continue;
    const auto same = std::find_if(first.begin(), first.end(),
                                   [&](std::size_t f) { return start_[f] == start_[c] && end_[f] == end_[c]; });
    motion_class_[c] = static_cast<std::uint32_t>(same - first.begin()) + 1;
    if (same == first.end()) first.push_back(c);
  }
}

void FrontBasedEngine::refit() {
  std::vector<ComponentId> changed;
  for (std::uint32_t c = 0; c < end_.size(); ++c)
    if (work_ == FrontBasedWork::AllComponents || fitted_start_[c] != start_[c] || fitted_end_[c] != end_[c])
      changed.push_back(ComponentId(c));
  fitted_start_ = start_;
  fitted_end_ = end_;
  bvh_refit(fixed_.bvh, fixed_.refit_plan, refit_input(), changed, bounds_, options_.executor);
}

/// True if the components of the pair move relative to each other; others cannot collide.
bool FrontBasedEngine::moves_against(std::uint64_t key) const {
  const NodePair p = pair_of_key(key);
  return motion_class_[fixed_.bvh.component_of[p.a]] != motion_class_[fixed_.bvh.component_of[p.b]];
}

NarrowPhaseKernel FrontBasedEngine::kernel() const {
  const GhostVertices& ghosts = guards_.ghosts();
  NarrowPhaseKernel kernel{front_.triangle_pairs(),
                           triangles(),
                           {ghosts.displaced, ghosts.margins, start_, end_},
                           bounds_,
                           fixed_.bvh.component_of,
                           fixed_.features,
                           guards_.rules(),
                           options_.test};
  kernel.cull = PairCull::None;
  return kernel;
}

PairTestResults FrontBasedEngine::test_triangle_pairs() {
  const Span<const std::uint64_t> pairs = front_.triangle_pairs();
  const NarrowPhaseKernel kernel = this->kernel();
  std::vector<PairTestResults> parts(static_cast<std::size_t>(options_.executor.thread_count()));
  options_.executor.for_each_heavy(parts.size(), [&](std::size_t p) {
    PairTestResults results;
    for (std::size_t i = pairs.size() * p / parts.size(); i < pairs.size() * (p + 1) / parts.size(); ++i)
      if (moves_against(pairs[i])) kernel(i, results);
    parts[p] = std::move(results);
  });
  PairTestResults all;
  for (const PairTestResults& part : parts) {
    append(all.contacts, part.contacts);
    append(all.intersections, part.intersections);
    all.tests += part.tests;
  }
  return all;
}

/// The triangle pairs of embedded pairs that move against each other, ascending.
std::vector<std::uint64_t> FrontBasedEngine::embedded_triangle_pairs() const {
  std::vector<std::uint64_t> own;
  for (const ComponentPair& pair : embedded_.pairs()) {
    if (motion_class_[pair.a.value] == motion_class_[pair.b.value]) continue;
    append(own, triangle_pairs_of(front_.triangle_pairs(), fixed_.bvh.component_of, pair.a, pair.b));
  }
  std::sort(own.begin(), own.end());
  return own;
}

void FrontBasedEngine::test_embedded_pairs(PairTestResults& results, double path_deviation) {
  if (!embedded_.any_moves(start_, end_)) return;
  const std::vector<std::uint64_t> own = embedded_triangle_pairs();
  for (const PartingPair& found : embedded_.parting(embedded_step(path_deviation), own, results.intersections)) {
    const auto contacts = contacts_after(found, kernel(), options_.executor);
    if (!contacts) continue;
    parting_.push_back(found.pair);
    append(results.contacts, *contacts);
    results.tested(found.triangle_pairs.size());
  }
}

std::vector<ComponentPair> FrontBasedEngine::overlapping_pairs() const {
  std::vector<ComponentPair> pairs = guards_.overlapping();
  append(pairs, embedded_.pairs());
  std::sort(pairs.begin(), pairs.end(),
            [](const ComponentPair& x, const ComponentPair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  return pairs;
}

void FrontBasedEngine::commit() {
  DISMANTLE_EXPECT(may_commit_);
  std::swap(start_vertices_, end_vertices_);
  std::swap(start_, end_);
  part(parting_);
  guards_.part(end_, start_);
  parting_.clear();
  may_commit_ = false;
}

void FrontBasedEngine::part(const std::vector<ComponentPair>& parted) {
  for (const ComponentPair& pair : parted) guards_.end_free(pair.a, pair.b);
  embedded_.part(parted);
}

void FrontBasedEngine::jump(Span<const RigidTransform> state) {
  set_end(state);
  start_ = end_;
  start_vertices_ = end_vertices_;
  refit();
  may_commit_ = false;
  parting_.clear();
  part(embedded_.apart(embedded_step(0)));
  guards_.jump(state);
}

}  // namespace

std::unique_ptr<SweepEngine> make_front_based_engine(const Assembly& assembly, const PairStates& pairs,
                                                     const CollisionOptions& options, FrontBasedWork work) {
  return std::make_unique<FrontBasedEngine>(assembly, pairs, options, work);
}

}  // namespace dismantle
