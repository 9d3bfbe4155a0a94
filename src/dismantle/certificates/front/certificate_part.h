// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dismantle {

/// A pair of nodes of two trees, by their indices.
struct FrontPair {
  std::uint32_t a;  ///< Node of A's tree.
  std::uint32_t b;  ///< Node of B's tree.
};

/// The shortest CertificatePart::merge_period().
inline constexpr std::size_t kMergePeriod = 8;

/// A part of a front: pairs of nodes with their certificates, unordered, padded to whole blocks.
class CertificatePart {
 public:
  /// Number of pairs.
  std::size_t size() const { return pairs_.size(); }
  /// The nodes of pair i.
  const FrontPair& pair(std::size_t i) const { return pairs_[i]; }
  /// The certificate of pair i.
  Certificate certificate(std::size_t i) const { return blocks().certificate(i); }
  /// NodeHull::kind of the certificate of pair i.
  float kind(std::size_t i) const { return data_[CertificateBlocks::index(i, 16)]; }
  /// NodeHull::center of the certificate of pair i.
  Vec3f center(std::size_t i) const {
    return {data_[CertificateBlocks::index(i, 4)], data_[CertificateBlocks::index(i, 5)],
            data_[CertificateBlocks::index(i, 6)]};
  }
  /// All certificates, for kernels.
  CertificateBlocks blocks() const { return {data_.data()}; }
  /// Number of blocks.
  std::size_t block_count() const { return changed_.size(); }
  /// True if the block has changed since the last call for it; for those who keep a copy.
  bool take_changed(std::size_t block) { return std::exchange(changed_[block], std::uint8_t{0}) != 0; }
  /// Marks all blocks as changed.
  void mark_changed() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{1}); }

  /// Number of sweeps from one search for siblings to merge to the next.
  std::size_t merge_period() const { return merge_period_; }
  /// Changes that.
  void set_merge_period(std::size_t sweeps) { merge_period_ = sweeps; }

  /// Adds a pair at the end.
  void append(const FrontPair& pair, const Certificate& certificate);
  /// Replaces pair i.
  void set(std::size_t i, const FrontPair& pair, const Certificate& certificate);
  /// Replaces the certificate of pair i.
  void set_certificate(std::size_t i, const Certificate& certificate);
  /// Removes pair i; the last one takes its slot.
  void remove(std::size_t i);

 private:
  void resize_blocks(std::size_t count);

  std::vector<FrontPair> pairs_;
  std::vector<float> data_;
  std::vector<std::uint8_t> changed_;  // one flag a block
  std::size_t merge_period_ = kMergePeriod;
};

}  // namespace dismantle
