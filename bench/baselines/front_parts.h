// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/front/front.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The BVTT front as front-based decomposition has it (Tang, Manocha, Tong, "MCCD: Multi-core collision detection
/// between deformable models using front-based decomposition", Graphical Models 2010): each step the front is cut into
/// as many equal parts as there are cores; each core sprouts its own part, depth-first, and writes the new front and
/// the triangle pairs to lists of its own, so that no two cores share anything.
///
/// That paper prunes by looking for siblings; here the front is started anew instead, by the rule of Front, so that it
/// does not grow for ever.
///
/// Guarantee: after update(), triangle_pairs() are exactly the pairs of leaves of different components whose bounds
/// overlap; without those of one motion class, where classes are given.
class FrontParts {
 public:
  /// @param parts how many cores share the work, > 0
  explicit FrontParts(int parts) : parts_(static_cast<std::size_t>(parts)) {}

  /// Brings the front up to the bounds. Where `input.motion_class` is empty every node is looked at, whatever moves;
  /// else nodes of two components of one class are kept as they are.
  /// @pre the same tree every time; every node is fitted
  void update(const FrontInput& input, const Executor& executor);

  /// Keys (pair_key) of leaf pairs, in no particular order.
  Span<const std::uint64_t> triangle_pairs() const { return triangle_pairs_; }
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
  std::size_t excess_ = 0;      // nodes looked at beyond it since then
};

}  // namespace dismantle
