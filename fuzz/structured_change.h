// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

/// One change of bytes that knows nothing of what they mean: libFuzzer's, or that of replay.cpp.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace dismantle::fuzz {

/// The random choices of a mutator.
class Choices {
 public:
  explicit Choices(unsigned seed) : random_(seed) {}
  /// In [0, n); 0 where n is 0.
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  /// One of the elements. @pre there are some
  template <class Range>
  const auto& of(const Range& range) {
    return std::data(range)[below(std::size(range))];
  }

 private:
  std::minstd_rand random_;
};

/// Bytes [begin, end) of a text.
struct TextRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

inline void change_bytes(std::string& text, std::size_t max_size) {
  const std::size_t size = std::min(text.size(), max_size);
  text.resize(max_size);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, max_size));
}

/// A mutator of libFuzzer that makes up to three changes of a text.
/// @tparam Change is made of a text and Choices, and has make()
template <class Change>
std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  std::string text(reinterpret_cast<const char*>(data), size);
  Choices choices(seed);
  for (std::size_t changes = 1 + choices.below(3); changes > 0; --changes) Change(text, choices).make();
  if (text.size() > max_size) text.resize(max_size);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

}  // namespace dismantle::fuzz
