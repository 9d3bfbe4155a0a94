// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/bvtt_front.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The BVTT front of front-based decomposition (Tang, Manocha, Tong, "MCCD: Multi-core collision detection between
/// deformable models using front-based decomposition", Graphical Models 2010): each step the front is cut into as many
/// equal parts as there are cores; each core sprouts its own part, depth-first, and writes the new front and the
/// triangle pairs to its own lists, so that no two cores share data.
///
/// The published method prunes by merging siblings; here the front is restarted instead, by the rule of Front, so that
/// it does not grow without bound.
///
/// Guarantee: after update(), triangle_pairs() are exactly the pairs of leaves of different components whose bounds
/// overlap; without those of one motion class, where classes are given.
class FrontParts {
 public:
  /// @param parts number of cores that share the work, > 0
  explicit FrontParts(int parts) : parts_(static_cast<std::size_t>(parts)) {}

  /// Updates the front to the bounds. Where `input.motion_class` is empty every node is sprouted, whether it moves or
  /// not; else nodes of two components of one class are kept as they are.
  /// @pre the same tree every time; every node is fitted
  void update(const FrontInput& input, const Executor& executor);

  /// Keys (pair_key) of leaf pairs, in no particular order.
  Span<const std::uint64_t> triangle_pairs() const { return triangle_pairs_; }
  /// Number of nodes of the front.
  std::size_t size() const { return nodes_.size(); }

 private:
  struct Part {
    std::vector<std::uint64_t> nodes, triangle_pairs;
    std::vector<NodePair> open;
  };
  void start(const FrontInput& input);
  void sprout(std::uint64_t key, const FrontInput& input, Part& part) const;
  void join(const Executor& executor);

  std::vector<Part> parts_;
  std::vector<std::uint64_t> nodes_, triangle_pairs_;
  std::size_t fresh_size_ = 0;  // of the front after the last start
  std::size_t excess_ = 0;      // nodes sprouted beyond it since then
};

}  // namespace dismantle
