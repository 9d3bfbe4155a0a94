// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace dismantle {

/// The characters that the fonts of the system have: the sans-serif font and its fallbacks, as fontconfig finds them.
class FontCoverage {
 public:
  /// Of the fonts that are installed now.
  FontCoverage();
  ~FontCoverage();
  FontCoverage(FontCoverage&&) noexcept;             ///< Movable.
  FontCoverage& operator=(FontCoverage&&) noexcept;  ///< Movable.

  /// The characters of a text that no font has, each once, in their order; empty if it can be drawn. UTF-8; invalid
  /// bytes count as U+FFFD.
  std::string missing(const std::string& text) const;
  /// The text with U+FFFD in place of each character that no font has, and of invalid bytes.
  std::string drawable(const std::string& text) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
