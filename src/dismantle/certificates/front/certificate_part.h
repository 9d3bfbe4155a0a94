// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dismantle {

/// A pair of nodes.
struct FrontPair {
  std::uint32_t a, b;
};

/// A part of a front: pairs of nodes and their certificates, padded to whole blocks. In no order.
class CertificatePart {
 public:
  std::size_t size() const { return pairs_.size(); }
  const FrontPair& pair(std::size_t i) const { return pairs_[i]; }
  Certificate certificate(std::size_t i) const { return blocks().certificate(i); }
  /// Its axis, whatever it proves.
  Vec3f axis(std::size_t i) const { return blocks().vector(i, 0); }
  /// Of the certificate's hull.
  float kind(std::size_t i) const { return data_[CertificateBlocks::place(i, 16)]; }
  CertificateBlocks blocks() const { return {data_.data()}; }
  std::size_t block_count() const { return changed_.size(); }
  /// Whether something in a block is not what it was when this was asked last, for who keeps a copy.
  bool take_changed(std::size_t block) { return std::exchange(changed_[block], std::uint8_t{0}) != 0; }
  /// From now on all of it counts as changed.
  void mark_changed() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{1}); }

  void append(const FrontPair& pair, const Certificate& certificate);
  void set(std::size_t i, const FrontPair& pair, const Certificate& certificate);
  void set_certificate(std::size_t i, const Certificate& certificate);
  /// The last one takes the place of pair i.
  void remove(std::size_t i);

 private:
  void resize_blocks(std::size_t count);

  std::vector<FrontPair> pairs_;
  std::vector<float> data_;
  std::vector<std::uint8_t> changed_;  // of each block
};

}  // namespace dismantle
