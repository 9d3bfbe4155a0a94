// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/front/certificate_kernels.h"

#include <cstddef>
#include <cstdint>
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
  Certificate certificate(std::size_t i) const;
  /// Its axis, whatever it proves.
  Vec3f axis(std::size_t i) const { return vector(i, 0); }
  float offset(std::size_t i) const { return data_[CertificateBlocks::place(i, 3)]; }
  /// Of the certificate's hull.
  float kind(std::size_t i) const { return data_[CertificateBlocks::place(i, 16)]; }
  CertificateBlocks blocks() const { return {data_.data()}; }

  void append(const FrontPair& pair, const Certificate& certificate);
  void set(std::size_t i, const FrontPair& pair, const Certificate& certificate);
  void set_certificate(std::size_t i, const Certificate& certificate);
  /// The last one takes the place of pair i.
  void remove(std::size_t i);

 private:
  Vec3f vector(std::size_t i, std::size_t k) const {
    const float* from = data_.data() + CertificateBlocks::place(i, k);
    return {from[0], from[CertificateBlocks::kBlock], from[2 * CertificateBlocks::kBlock]};
  }

  std::vector<FrontPair> pairs_;
  std::vector<float> data_;
};

}  // namespace dismantle
