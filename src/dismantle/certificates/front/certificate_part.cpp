// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_part.h"

namespace dismantle {

void CertificatePart::resize_blocks(std::size_t count) {
  data_.resize(CertificateBlocks::index(count * CertificateBlocks::kBlock, 0));
  changed_.resize(count, 1);
}

void CertificatePart::append(const FrontPair& pair, const Certificate& certificate) {
  if (size() % CertificateBlocks::kBlock == 0) resize_blocks(block_count() + 1);
  pairs_.push_back(pair);
  set_certificate(size() - 1, certificate);
}

void CertificatePart::set(std::size_t i, const FrontPair& pair, const Certificate& certificate) {
  pairs_[i] = pair;
  set_certificate(i, certificate);
}

void CertificatePart::set_certificate(std::size_t i, const Certificate& c) {
  const NodeHull& h = c.hull;
  const float values[CertificateBlocks::kFields] = {c.axis.x,    c.axis.y,    c.axis.z,    c.offset,    h.center.x,
                                                    h.center.y,  h.center.z,  h.span[0].x, h.span[0].y, h.span[0].z,
                                                    h.span[1].x, h.span[1].y, h.span[1].z, h.span[2].x, h.span[2].y,
                                                    h.span[2].z, h.kind};
  float* to = data_.data() + CertificateBlocks::index(i, 0);
  for (std::size_t k = 0; k < CertificateBlocks::kFields; ++k) to[k * CertificateBlocks::kBlock] = values[k];
  changed_[i / CertificateBlocks::kBlock] = 1;
}

void CertificatePart::remove(std::size_t i) {
  set(i, pairs_.back(), certificate(size() - 1));
  pairs_.pop_back();
  if (size() % CertificateBlocks::kBlock == 0) resize_blocks(block_count() - 1);
}

}  // namespace dismantle
