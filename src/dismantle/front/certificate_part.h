// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/front/certificate_kernels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dismantle {

/// A pair of nodes, and the pair of which it is one half: both kNone for the roots.
struct FrontPair {
  std::uint32_t a, b;
  std::uint32_t parent_a, parent_b;
};

/// A part of a front: pairs of nodes and their certificates, as arrays padded to whole lanes. In no order.
class CertificatePart {
 public:
  std::size_t size() const { return pairs_.size(); }
  const FrontPair& pair(std::size_t i) const { return pairs_[i]; }
  Certificate certificate(std::size_t i) const;
  CertificateArrays arrays() const;

  void append(const FrontPair& pair, const Certificate& certificate);
  void set(std::size_t i, const FrontPair& pair, const Certificate& certificate);
  void set_certificate(std::size_t i, const Certificate& certificate);
  /// The last one takes the place of pair i.
  void remove(std::size_t i);

 private:
  static constexpr std::size_t kFields = 9;  // axis, point, offset, radius, epoch
  static constexpr std::size_t kPadding = 16;

  float* field(std::size_t k) { return data_.data() + k * capacity_; }
  const float* field(std::size_t k) const { return data_.data() + k * capacity_; }
  void grow();

  std::vector<FrontPair> pairs_;
  std::vector<float> data_;
  std::size_t capacity_ = 0;
};

}  // namespace dismantle
