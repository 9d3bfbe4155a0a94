// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/certificate_part.h"

#include <algorithm>

namespace dismantle {

Certificate CertificatePart::certificate(std::size_t i) const {
  Certificate c;
  c.axis = {field(0)[i], field(1)[i], field(2)[i]};
  c.point = {field(3)[i], field(4)[i], field(5)[i]};
  c.offset = field(6)[i];
  c.radius = field(7)[i];
  c.epoch = static_cast<std::uint32_t>(field(8)[i]);
  return c;
}

CertificateArrays CertificatePart::arrays() const {
  return {{field(0), field(1), field(2)}, {field(3), field(4), field(5)}, field(6), field(7), field(8)};
}

void CertificatePart::append(const FrontPair& pair, const Certificate& certificate) {
  if (size() == capacity_) grow();
  pairs_.push_back(pair);
  set_certificate(size() - 1, certificate);
}

void CertificatePart::set(std::size_t i, const FrontPair& pair, const Certificate& certificate) {
  pairs_[i] = pair;
  set_certificate(i, certificate);
}

void CertificatePart::set_certificate(std::size_t i, const Certificate& c) {
  const float values[kFields] = {
      c.axis.x, c.axis.y, c.axis.z, c.point.x, c.point.y, c.point.z, c.offset, c.radius, static_cast<float>(c.epoch)};
  for (std::size_t k = 0; k < kFields; ++k) field(k)[i] = values[k];
}

void CertificatePart::remove(std::size_t i) {
  const std::size_t last = size() - 1;
  pairs_[i] = pairs_[last];
  for (std::size_t k = 0; k < kFields; ++k) field(k)[i] = field(k)[last];
  pairs_.pop_back();
}

void CertificatePart::grow() {
  const std::size_t capacity = std::max(4 * kPadding, 2 * capacity_);
  std::vector<float> data(kFields * capacity);
  for (std::size_t k = 0; k < kFields; ++k)
    std::copy_n(data_.data() + k * capacity_, size(), data.data() + k * capacity);
  data_ = std::move(data);
  capacity_ = capacity;
}

}  // namespace dismantle
