// SPDX-License-Identifier: Apache-2.0
#include "tests/device/device_streams.h"

#include "dismantle/collision/vertex_kernel.h"
#include "tests/device/device_memory.cuh"

#include <algorithm>

namespace dismantle::device {

namespace {

constexpr std::size_t kStreams = 5;  // of the front: triangle pairs, kept, rested, sprouted, pending
using FrontViews = DeviceAppendView<std::uint64_t>[kStreams];

/// Every value by itself.
class GlobalLockSink {
 public:
  __device__ explicit GlobalLockSink(const FrontViews& views) : views_(views) {}
  __device__ void triangle_pair(std::uint64_t key) { views_[0].append(key); }
  __device__ void keep(std::uint64_t key) { views_[1].append(key); }
  __device__ void rest(std::uint64_t key) { views_[2].append(key); }
  __device__ void sprout(std::size_t index) { views_[3].append(index); }
  __device__ void pend(std::uint64_t key) { views_[4].append(key); }

 private:
  const FrontViews& views_;
};

constexpr unsigned kLocalCapacity = 256;  // 10 KiB of shared memory a block

/// A block's buffers in shared memory.
struct LocalBuffers {
  std::uint64_t values[kStreams][kLocalCapacity];
  unsigned count[kStreams];
  unsigned long long place[kStreams];
};

/// Into the block's buffers; what finds them full goes to the streams by itself.
class LocalLockSink {
 public:
  __device__ LocalLockSink(LocalBuffers& local, const FrontViews& views) : local_(local), views_(views) {}
  __device__ void triangle_pair(std::uint64_t key) { append(0, key); }
  __device__ void keep(std::uint64_t key) { append(1, key); }
  __device__ void rest(std::uint64_t key) { append(2, key); }
  __device__ void sprout(std::size_t index) { append(3, index); }
  __device__ void pend(std::uint64_t key) { append(4, key); }

 private:
  __device__ void append(unsigned stream, std::uint64_t value) {
    const unsigned place = atomicAdd(&local_.count[stream], 1u);
    if (place < kLocalCapacity) {
      local_.values[stream][place] = value;
    } else {
      views_[stream].append(value);
    }
  }

  LocalBuffers& local_;
  const FrontViews& views_;
};

/// The front's kernel with its streams, as a launch takes them by value.
struct FrontLaunch {
  FrontSproutKernel kernel;
  FrontViews views;
};

enum class FrontRound { First, Next };

template <FrontRound kRound, class Sink>
__device__ void look_at(const FrontSproutKernel& kernel, std::size_t i, Sink& sink) {
  if constexpr (kRound == FrontRound::First) {
    kernel.look(i, sink);
  } else {
    kernel.resume(i, sink);
  }
}

template <FrontRound kRound>
__global__ void sprout_with_global_lock(FrontLaunch launch) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i >= launch.kernel.items.size()) return;
  GlobalLockSink sink(launch.views);
  look_at<kRound>(launch.kernel, i, sink);
}

template <FrontRound kRound>
__global__ void sprout_with_local_lock(FrontLaunch launch) {
  __shared__ LocalBuffers local;
  if (threadIdx.x < kStreams) local.count[threadIdx.x] = 0;
  __syncthreads();
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i < launch.kernel.items.size()) {
    LocalLockSink sink(local, launch.views);
    look_at<kRound>(launch.kernel, i, sink);
  }
  __syncthreads();
  if (threadIdx.x < kStreams) {
    const unsigned s = threadIdx.x;
    local.count[s] = local.count[s] < kLocalCapacity ? local.count[s] : kLocalCapacity;
    local.place[s] = atomicAdd(launch.views[s].needed, static_cast<unsigned long long>(local.count[s]));
  }
  __syncthreads();
  for (unsigned s = 0; s < kStreams; ++s)
    for (unsigned k = threadIdx.x; k < local.count[s]; k += blockDim.x)
      if (local.place[s] + k < launch.views[s].storage.size())
        launch.views[s].storage[local.place[s] + k] = local.values[s][k];
}

template <FrontRound kRound>
void launch_front(const FrontLaunch& launch, DeviceLock lock) {
  const unsigned blocks = block_count(launch.kernel.items.size());
  if (blocks > 0 && lock == DeviceLock::Global) sprout_with_global_lock<kRound><<<blocks, kThreadsPerBlock>>>(launch);
  if (blocks > 0 && lock == DeviceLock::Local) sprout_with_local_lock<kRound><<<blocks, kThreadsPerBlock>>>(launch);
  finish("the front's kernel");
}

void add_to(std::vector<std::uint64_t>& stream, const std::vector<std::uint64_t>& values) {
  stream.insert(stream.end(), values.begin(), values.end());
}

/// Where the narrow phase's kernel puts what it finds.
class NarrowSink {
 public:
  __device__ NarrowSink(DeviceAppendView<TrianglePairContact> contacts, DeviceAppendView<std::uint64_t> intersections,
                        unsigned long long* tests)
      : contacts_(contacts), intersections_(intersections), tests_(tests) {}
  __device__ void contact(const TrianglePairContact& found) { contacts_.append(found); }
  __device__ void intersection(std::uint64_t key) { intersections_.append(key); }
  __device__ void tested(std::size_t count) { atomicAdd(tests_, static_cast<unsigned long long>(count)); }

 private:
  DeviceAppendView<TrianglePairContact> contacts_;
  DeviceAppendView<std::uint64_t> intersections_;
  unsigned long long* tests_;
};

struct NarrowBody {
  NarrowPhaseKernel kernel;
  DeviceAppendView<TrianglePairContact> contacts;
  DeviceAppendView<std::uint64_t> intersections;
  unsigned long long* tests;

  __device__ void operator()(std::size_t i) const {
    NarrowSink sink(contacts, intersections, tests);
    kernel(i, sink);
  }
};

/// A kernel over items that are listed.
struct NodeListBody {
  BvhRefitNodeKernel kernel;
  Span<const NodeIndex> inner;

  __device__ void operator()(std::size_t i) const { kernel(inner[i]); }
};

/// The inner nodes, counted from the first, by their height above the leaves.
std::vector<std::vector<NodeIndex>> nodes_by_level(const Bvh& bvh) {
  std::vector<std::size_t> height(bvh.node_count(), 0);
  std::vector<std::vector<NodeIndex>> levels;
  for (NodeIndex i = 0; i < bvh.children.size(); ++i) {
    const std::size_t level = std::max(height[bvh.children[i].left], height[bvh.children[i].right]);
    height[bvh.leaf_count() + i] = level + 1;
    if (levels.size() <= level) levels.resize(level + 1);
    levels[level].push_back(i);
  }
  return levels;
}

}  // namespace

std::string device_name() {
  int count = 0;
  if (cudaGetDeviceCount(&count) != cudaSuccess || count == 0) return {};
  cudaDeviceProp properties{};
  check(cudaGetDeviceProperties(&properties, 0), "cudaGetDeviceProperties");
  return properties.name;
}

std::vector<Vec3> moved_vertices(Span<const Vec3> assembled, const RigidTransform& transform) {
  const DeviceArray<Vec3> from(assembled);
  DeviceArray<Vec3> moved(assembled.size());
  for_each(assembled.size(), VertexUpdateKernel{transform, from.view(), moved.view()}, "the vertices' kernel");
  return moved.values();
}

std::vector<Kdop16> fitted_bounds(const Bvh& bvh, const BvhRefitInput& input) {
  const DeviceArray<Vec3> vertices_t0(input.vertices_t0), vertices_t1(input.vertices_t1);
  const DeviceArray<Face> faces(input.faces);
  DeviceArray<Kdop16> bounds(bvh.node_count());
  const float margin = static_cast<float>(input.margin * (1 + 1e-6));
  for_each(bvh.leaf_count(),
           BvhRefitLeafKernel{vertices_t0.view(), vertices_t1.view(), faces.view(), bounds.view(), margin},
           "the leaves' kernel");
  const DeviceArray<BvhChildren> children{Span<const BvhChildren>(bvh.children)};
  BvhView tree(bvh);
  tree.children = children.view();
  for (const std::vector<NodeIndex>& level : nodes_by_level(bvh)) {
    const DeviceArray<NodeIndex> inner{Span<const NodeIndex>(level)};
    for_each(level.size(), NodeListBody{{tree, bounds.view()}, inner.view()}, "the inner nodes' kernel");
  }
  return bounds.values();
}

FrontFinds sprouted_front(const FrontSproutKernel& kernel, DeviceLock lock, std::size_t capacity) {
  const DeviceArray<BvhChildren> children(kernel.tree.children);
  const DeviceArray<std::uint32_t> component_of(kernel.tree.component_of), motion_class(kernel.motion_class);
  const DeviceArray<Kdop16> bounds(kernel.bounds);
  FrontLaunch launch{kernel, {}};
  launch.kernel.tree.children = children.view();
  launch.kernel.tree.component_of = component_of.view();
  launch.kernel.bounds = bounds.view();
  launch.kernel.motion_class = motion_class.view();

  FrontFinds finds;
  std::unique_ptr<DeviceAppendBuffer<std::uint64_t>> buffers[kStreams];
  for (auto& buffer : buffers) buffer = std::make_unique<DeviceAppendBuffer<std::uint64_t>>(capacity);
  std::vector<std::uint64_t> items(kernel.items.begin(), kernel.items.end());
  for (int round = 0; !items.empty(); ++round) {
    const DeviceArray<std::uint64_t> round_items{Span<const std::uint64_t>(items)};
    launch.kernel.items = round_items.view();
    for (bool full = true; full;) {
      for (std::size_t s = 0; s < kStreams; ++s) launch.views[s] = buffers[s]->start();
      round == 0 ? launch_front<FrontRound::First>(launch, lock) : launch_front<FrontRound::Next>(launch, lock);
      full = false;
      for (auto& buffer : buffers) full = buffer->grown() || full;
      finds.replays += full ? 1 : 0;
    }
    add_to(finds.triangle_pairs, buffers[0]->values());
    add_to(finds.kept, buffers[1]->values());
    add_to(finds.rested, buffers[2]->values());
    add_to(finds.sprouted, buffers[3]->values());
    items = buffers[4]->values();
  }
  return finds;
}

NarrowFinds tested_pairs(const NarrowPhaseKernel& kernel, std::size_t capacity) {
  const DeviceArray<std::uint64_t> pairs(kernel.pairs);
  const DeviceArray<Vec3> vertices_t0(kernel.triangles.vertices_t0), vertices_t1(kernel.triangles.vertices_t1);
  const DeviceArray<Face> faces(kernel.triangles.faces);
  const DeviceArray<Kdop16> bounds(kernel.bounds);
  const DeviceArray<std::uint32_t> component_of(kernel.component_of), motion_class(kernel.motion_class);
  const DeviceArray<std::uint8_t> features(kernel.features);
  const DeviceArray<PairRuleEntry> rules(kernel.rules.table);
  DeviceAppendBuffer<TrianglePairContact> contacts(capacity);
  DeviceAppendBuffer<std::uint64_t> intersections(capacity);
  DeviceArray<unsigned long long> tests(1);

  NarrowBody body{kernel, {}, {}, tests.data()};
  body.kernel.pairs = pairs.view();
  body.kernel.triangles = {vertices_t0.view(), vertices_t1.view(), faces.view()};
  body.kernel.bounds = bounds.view();
  body.kernel.component_of = component_of.view();
  body.kernel.features = features.view();
  body.kernel.motion_class = motion_class.view();
  body.kernel.rules.table = rules.view();

  NarrowFinds finds;
  for (bool full = true; full;) {
    body.contacts = contacts.start();
    body.intersections = intersections.start();
    check(cudaMemset(tests.data(), 0, sizeof(unsigned long long)), "cudaMemset");
    for_each(kernel.pairs.size(), body, "the narrow phase's kernel");
    const bool contacts_full = contacts.grown(), intersections_full = intersections.grown();
    full = contacts_full || intersections_full;
    finds.replays += full ? 1 : 0;
  }
  finds.contacts = contacts.values();
  finds.intersections = intersections.values();
  finds.tests = tests.values()[0];
  return finds;
}

}  // namespace dismantle::device
