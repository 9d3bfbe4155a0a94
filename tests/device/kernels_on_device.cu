// SPDX-License-Identifier: Apache-2.0
#include "tests/device/kernels_on_device.h"

#include "bench/baselines/device_append_buffer.cuh"
#include "dismantle/streams/vertex_kernel.h"

#include <algorithm>

namespace dismantle::device {

namespace {

/// Receives the results of the narrow-phase kernel.
class NarrowSink {
 public:
  __device__ NarrowSink(AppendView<TrianglePairContact> contacts, AppendView<std::uint64_t> intersections,
                        std::uint64_t* tests)
      : contacts_(contacts), intersections_(intersections), tests_(tests) {}
  __device__ void contact(const TrianglePairContact& found) { contacts_.append(found); }
  __device__ void intersection(std::uint64_t key) { intersections_.append(key); }
  __device__ void tested(std::size_t count) { atomic_add(tests_, count); }

 private:
  AppendView<TrianglePairContact> contacts_;
  AppendView<std::uint64_t> intersections_;
  std::uint64_t* tests_;
};

struct NarrowBody {
  NarrowPhaseKernel kernel;
  AppendView<TrianglePairContact> contacts;
  AppendView<std::uint64_t> intersections;
  std::uint64_t* tests;

  __device__ void operator()(std::size_t i) const {
    NarrowSink sink(contacts, intersections, tests);
    kernel(i, sink);
  }
};

/// A kernel over a list of items.
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

std::vector<Vec3> moved_vertices(Span<const Vec3> assembled, const RigidTransform& transform) {
  CudaQueue queue;
  const DeviceArray<Vec3> from(queue, assembled);
  DeviceArray<Vec3> moved(queue, assembled.size());
  queue.launch(assembled.size(), VertexUpdateKernel{transform, from.view(), moved.view()});
  return brought_down(queue, moved, moved.size());
}

std::vector<Kdop16> fitted_bounds(const Bvh& bvh, const BvhRefitInput& input) {
  CudaQueue queue;
  const DeviceArray<Vec3> vertices_t0(queue, input.vertices_t0), vertices_t1(queue, input.vertices_t1);
  const DeviceArray<Face> faces(queue, input.faces);
  DeviceArray<Kdop16> bounds(queue, bvh.node_count());
  const float margin = static_cast<float>(input.margin * (1 + 1e-6));
  queue.launch(bvh.leaf_count(),
               BvhRefitLeafKernel{vertices_t0.view(), vertices_t1.view(), faces.view(), bounds.view(), margin});
  const DeviceArray<BvhChildren> children(queue, Span<const BvhChildren>(bvh.children));
  BvhView tree(bvh);
  tree.children = children.view();
  for (const std::vector<NodeIndex>& level : nodes_by_level(bvh)) {
    const DeviceArray<NodeIndex> inner(queue, Span<const NodeIndex>(level));
    queue.launch(level.size(), NodeListBody{{tree, bounds.view()}, inner.view()});
    queue.wait();  // the list is destroyed
  }
  return brought_down(queue, bounds, bounds.size());
}

NarrowFinds tested_pairs(const NarrowPhaseKernel& kernel, std::size_t capacity) {
  CudaQueue queue;
  const DeviceArray<std::uint64_t> pairs(queue, kernel.pairs);
  const DeviceArray<Vec3> vertices_t0(queue, kernel.triangles.vertices_t0),
      vertices_t1(queue, kernel.triangles.vertices_t1);
  const DeviceArray<Face> faces(queue, kernel.triangles.faces);
  const DeviceArray<Kdop16> bounds(queue, kernel.bounds);
  const DeviceArray<std::uint32_t> component_of(queue, kernel.component_of);
  const DeviceArray<Vec3> displaced(queue, kernel.ghosts.displaced);
  const DeviceArray<float> margins(queue, kernel.ghosts.margins);
  const DeviceArray<RigidTransform> start(queue, kernel.ghosts.start), end(queue, kernel.ghosts.end);
  const DeviceArray<std::uint8_t> features(queue, kernel.features);
  const DeviceArray<PairRuleEntry> rules(queue, kernel.rules.table);
  DeviceAppendBuffer<TrianglePairContact> contacts(queue, capacity);
  DeviceAppendBuffer<std::uint64_t> intersections(queue, capacity);
  MirroredArray<std::uint64_t> tests(queue, 1);

  NarrowBody body{kernel, {}, {}, tests.on_device().data()};
  body.kernel.pairs = pairs.view();
  body.kernel.triangles = {vertices_t0.view(), vertices_t1.view(), faces.view()};
  body.kernel.bounds = bounds.view();
  body.kernel.component_of = component_of.view();
  body.kernel.features = features.view();
  body.kernel.ghosts = {displaced.view(), margins.view(), start.view(), end.view()};
  body.kernel.rules.table = rules.view();

  NarrowFinds finds;
  for (bool full = true; full;) {
    body.contacts = contacts.start();
    body.intersections = intersections.start();
    tests.on_host()[0] = 0;
    tests.copy_up(queue);
    queue.launch(kernel.pairs.size(), body);
    tests.copy_down(queue);
    const bool contacts_full = contacts.grown(), intersections_full = intersections.grown();
    full = contacts_full || intersections_full;
    finds.replays += full ? 1 : 0;
  }
  finds.contacts = contacts.values();
  finds.intersections = intersections.values();
  finds.tests = tests.on_host()[0];
  return finds;
}

}  // namespace dismantle::device
