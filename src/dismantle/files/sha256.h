// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dismantle {

/// Incremental SHA-256 (FIPS 180-4). Identifies the files of an assembly; not for security.
class Sha256 {
 public:
  /// Adds bytes to the message.
  void update(std::string_view bytes);

  /// The digest of all bytes so far as 64 lower-case hexadecimal digits; the object then starts a new message.
  std::string finish();

 private:
  void absorb(const unsigned char* blocks, std::size_t count);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> pending_{};
  std::uint64_t length_ = 0;  // bytes so far
};

/// The SHA-256 of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace dismantle
